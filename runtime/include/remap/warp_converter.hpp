// Converters of whole materials by a compiled warp.
#pragma once

#include <memory>

#include "remap/converter.hpp"
#include "remap/warp_fit.hpp"
#include "remap/workflow_models.hpp"

namespace remap {

// Diffuse, specular and width of the source of a warp to those of its template, all rows wanted. A metallic
// source becomes a specular one first, by equation (2). Colors in one row stand for grey. Throws kInput as
// require_valid() does.
std::unique_ptr<Converter> make_warp_converter(const WarpMapFit& fit, const WorkflowEnd& source,
                                               InstructionSet set = best_instruction_set());

}  // namespace remap
