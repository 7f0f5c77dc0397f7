// Converters of whole materials between workflows.
#pragma once

#include <memory>
#include <vector>

#include "remap/converter.hpp"
#include "remap/workflow_models.hpp"

namespace remap {

// The parameters of a material of a workflow, in the order of Parameter.
std::vector<Parameter> parameters_of(const WorkflowEnd& end);

// The stages of a conversion from one workflow to another.
struct WorkflowStages {
  WorkflowEnd source, target;
  // Between the BRDFs of both ends; null if they are the same. Must outlive the converter.
  const Converter* brdf = nullptr;
  RoughnessConvention width = RoughnessConvention::kRoughness;  // of both ends if `brdf` is null
  // To metallic; ignored if the target is a specular workflow.
  WorkflowFormula formula = Projection{kCleanPrior};
};

// Converts block by block, in one pass over the rows: equation (2) if the source is metallic, then `brdf` for
// width and specular, then `formula` if the target is metallic. The diffuse lobe keeps its reflectance where
// `brdf` changes specular, so scaled diffuse is scaled to the new specular. Throws kInput as require_valid()
// does.
std::unique_ptr<Converter> make_workflow_converter(const WorkflowStages& stages,
                                                   InstructionSet set = best_instruction_set());

}  // namespace remap
