// This file compiles a warp to a table of template parameters over the box of the source's coordinates.
#pragma once

#include "warp/material.hpp"
#include "warp/nearest_texel.hpp"
#include "warp/warp_function.hpp"

namespace remap {

// Compiles a table. `positions` belong to the source texels, which determine the box. `nearest` finds texels
// of `target`. A node has the parameters of the texel closest to its image. They are unchanged (CopiedNodes)
// if `exact`, otherwise rounded to a byte and blended with other nodes. Blended tables use up to 250 KB. They
// differ from the exact copy by about the distance of neighboring template texels, 1.5 to 2 % of the
// template's spread. Exact tables have more nodes, because the closest node has a larger error than a blend.
// Throws kUsage if an exact table needs more than 65536 texels.
ParameterTable compile_table(const SmoothWarp& warp, const Points& positions, const NearestTexel& nearest,
                             const WarpMaterial& target, bool exact);

}  // namespace remap
