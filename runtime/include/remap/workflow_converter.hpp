// Converters of whole materials between workflows.
#pragma once

#include <memory>
#include <vector>

#include "remap/converter.hpp"
#include "remap/workflow_models.hpp"

namespace remap {

// What materials of a workflow are made of, in the order of Parameter.
std::vector<Parameter> parameters_of(const WorkflowEnd& end);

// What leads from a material of one workflow to one of another.
struct WorkflowStages {
  WorkflowEnd source, target;
  // Of width and specular, between the BRDFs that both ends stand on; null where they are the same. Must
  // outlive the converter.
  const Converter* brdf = nullptr;
  RoughnessConvention width = RoughnessConvention::kRoughness;  // of both ends where there is no `brdf`
  // To metallic; not used where the target is a specular workflow.
  WorkflowFormula formula = Projection{kCleanPrior};
};

// In one pass over the rows, block by block: a metallic source becomes a specular one by equation (2), width
// and specular go through `brdf`, and the result becomes metallic by `formula` where the target is. Where
// `brdf` changes specular, the diffuse lobe keeps its reflectance: diffuse that is scaled is what remains of
// it beside the new specular. Throws kInput as require_valid() does.
std::unique_ptr<Converter> make_workflow_converter(const WorkflowStages& stages,
                                                   InstructionSet set = best_instruction_set());

}  // namespace remap
