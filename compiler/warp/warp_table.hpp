// This file compiles a warp to a table of template parameters over the box of the source's coordinates. It
// also finds the texel of the template that is closest to a position. So all results are reflectances of the
// template (An et al. 2011, principle 5).
#pragma once

#include <cstdint>
#include <vector>

#include "warp/coordinates.hpp"
#include "warp/material.hpp"
#include "warp/registration.hpp"

namespace remap {

// Returns the index of the closest position for each point. Ignores positions with NaN; at least one row must
// be finite.
std::vector<std::uint32_t> nearest_texels(const Points& positions, const Points& points);

// Compiles a table. `positions` belong to the source texels, which determine the box. `target_positions`
// belong to the texels of `target`. A node has the parameters of the texel closest to its image. They are
// unchanged (CopiedNodes) if `exact`, otherwise rounded to a byte and blended with other nodes. Blended
// tables use up to 250 KB. They differ from the exact copy by about the distance of neighboring template
// texels, 1.5 to 2 % of the template's spread. Exact tables have more nodes, because the closest node has a
// larger error than a blend. Throws kUsage if an exact table needs more than 65536 texels.
ParameterTable compile_table(const SmoothWarp& warp, const Points& positions, const Points& target_positions,
                             const WarpMaterial& target, bool exact);

}  // namespace remap
