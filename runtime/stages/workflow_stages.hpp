// Stages between the workflows of whole materials.
#pragma once

#include <memory>
#include <string>

#include "remap/converter.hpp"
#include "remap/workflow.hpp"
#include "stages/kernels.hpp"
#include "stages/stage.hpp"

namespace remap {

// Base color and metallic to diffuse and specular by equation (2); the width stays. `diffuse`, `width`: what
// diffuse becomes, and what the width is. Throws kInput, beginning with `context`, as require_valid() does.
std::shared_ptr<const Stage> specular_stage(const MetallicWorkflow& source, DiffuseConvention diffuse,
                                            RoughnessEncoding width, InstructionSet set,
                                            const std::string& context);

// As make_workflow_converter() without BRDF, from a metallic workflow whose dielectrics have an F0 for each
// texel: kSpecular of the source (KHR_materials_specular). The F0 of `stages.source` does not count; diffuse
// is what max(F0) leaves.
std::unique_ptr<Converter> make_dielectric_converter(const WorkflowStages& stages, InstructionSet set);

}  // namespace remap
