// Stages between the workflows of whole materials.
#pragma once

#include <memory>
#include <string>

#include "remap/workflow.hpp"
#include "stages/kernels.hpp"
#include "stages/stage.hpp"

namespace remap {

// Base color and metallic to diffuse and specular by equation (2); the width stays. `diffuse`, `width`: what
// diffuse becomes, and what the width is. Throws kInput, beginning with `place`, as require_valid() does.
std::shared_ptr<const Stage> specular_stage(const MetallicWorkflow& source, DiffuseConvention diffuse,
                                            RoughnessConvention width, InstructionSet set,
                                            const std::string& place);

}  // namespace remap
