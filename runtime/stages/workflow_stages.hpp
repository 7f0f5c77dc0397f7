// This file makes stages between the workflows of whole materials.
#pragma once

#include <memory>
#include <string>

#include "remap/converter.hpp"
#include "remap/workflow.hpp"
#include "stages/kernels.hpp"
#include "stages/stage.hpp"

namespace remap {

// Makes a stage that converts base color and metallic to diffuse and specular by equation (2). The width
// stays unchanged. `diffuse` is the convention of the result, and `width` is the kind of width. Throws
// kInput, beginning with `context`, like require_valid().
std::shared_ptr<const Stage> specular_stage(const MetallicWorkflow& source, DiffuseConvention diffuse,
                                            RoughnessEncoding width, InstructionSet set,
                                            const std::string& context);

// Returns the id, models and encodings of a converter between workflows.
ConverterInfo ends_of(const WorkflowStages& stages, InstructionSet set);

// Makes a converter like make_workflow_converter() without BRDF, from a metallic workflow. Each texel has its
// own F0 of dielectrics, in kSpecular of the source (KHR_materials_specular). The F0 of `stages.source` is
// not used. Diffuse is scaled by 1 - max(F0).
std::unique_ptr<Converter> make_dielectric_converter(const WorkflowStages& stages, InstructionSet set);

}  // namespace remap
