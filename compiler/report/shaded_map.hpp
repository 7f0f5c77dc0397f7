// Maps of a material under a light that shows color and gloss.
#pragma once

#include <array>
#include <vector>

#include "renderer/brdf.hpp"
#include "report/picture_grid.hpp"

namespace remapc {

using DisplayColor = std::array<float, 3>;  // 0 to 1, encoded for a display

// Display values of the samples of `grid` (samples_of(), or what became of those). The map lies on a cushion,
// whose normals lean outwards by up to 35 degrees at the ends of the longer side, seen from far above: a key
// light from the upper left and a weaker one from the lower right give highlights as wide as the material's
// lobe is, even surroundings give metals their color. Texels that are not finite are black.
Image shaded_map(const PictureGrid& grid, const std::vector<remap::WarpTexel>& samples,
                 const BrdfModel& model);

// The color in the middle of the cushion, for points that stand for a texel.
DisplayColor shaded_color(const remap::WarpTexel& texel, const BrdfModel& model);

}  // namespace remapc
