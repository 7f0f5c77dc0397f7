// This file makes stages between the workflows of whole materials.
#pragma once

#include <memory>
#include <string>

#include "remap/converter.hpp"
#include "remap/workflow.hpp"
#include "stages/kernels.hpp"
#include "stages/stage.hpp"

namespace remap {

// Converts base color and metallic to diffuse and specular by equation (2); the width stays unchanged.
// `diffuse` is the convention of the result, and `width` the meaning of the width. Throws kInput, beginning
// with `context`, like require_valid().
std::shared_ptr<const Stage> specular_stage(const MetallicWorkflow& source, DiffuseConvention diffuse,
                                            RoughnessEncoding width, InstructionSet set,
                                            const std::string& context);

// Returns the id, models and encodings of a converter between workflows.
ConverterInfo ends_of(const WorkflowStages& stages, InstructionSet set);

// Works like make_workflow_converter() without BRDF, from a metallic workflow with an F0 for the dielectrics
// of each texel: kSpecular of the source (KHR_materials_specular). It ignores the F0 of `stages.source`.
// Diffuse is scaled by 1 - max(F0).
std::unique_ptr<Converter> make_dielectric_converter(const WorkflowStages& stages, InstructionSet set);

}  // namespace remap
