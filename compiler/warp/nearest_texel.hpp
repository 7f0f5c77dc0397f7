// This file finds the texel of the template that is closest to a position. So all results are reflectances of
// the template (An et al. 2011, principle 5).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "warp/coordinates.hpp"

namespace remap {

// A NearestTexel returns the index of the closest position for each point.
using NearestTexel = std::function<std::vector<std::uint32_t>(const Points& points)>;

// Ignores positions with NaN; at least one row must be finite.
NearestTexel nearest_texel(const Points& positions);

}  // namespace remap
