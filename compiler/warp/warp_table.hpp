// The warp compiled: a table of template parameters over the box of the source's coordinates.
#pragma once

#include "warp/nearest_texel.hpp"
#include "warp/space/material.hpp"
#include "warp/warp_function.hpp"

namespace remapc {

// Nodes along each dimension by default. Blended: as many as 250 KB hold; differences from the exact copy are
// those between neighbouring texels of the template, 1.5 to 2 % of its spread. Copied (`exact`): more, since
// the nearest node errs by more than a blend of those around.
std::size_t default_nodes(int dimension, bool exact) noexcept;

// `positions` of the source's texels give the box; `nearest` finds texels of `target`. A node holds the
// parameters of the texel nearest to its image: as they are (CopiedNodes) where `exact`, else to a byte each
// and blended with those of other nodes. Throws kUsage where an exact table needs more than 65536 texels.
remap::ParameterTable compile_table(const AppearanceWarp& warp, const Points& positions,
                                    const NearestTexel& nearest, const WarpMaterial& target,
                                    std::size_t nodes, bool exact = false);

}  // namespace remapc
