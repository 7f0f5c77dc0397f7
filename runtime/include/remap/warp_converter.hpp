// Converters of whole materials by a compiled warp.
#pragma once

#include <memory>

#include "remap/converter.hpp"
#include "remap/warp_fit.hpp"
#include "remap/workflow_models.hpp"

namespace remap {

// Converts diffuse, specular and width of the source of a warp to those of its template; all target rows must
// be present. A metallic source is first converted to a specular one by equation (2). A color in one row is
// grey. Throws kInput as require_valid() does.
std::unique_ptr<Converter> make_warp_converter(const WarpMapFit& fit, const WorkflowEnd& source,
                                               InstructionSet set = best_instruction_set());

}  // namespace remap
