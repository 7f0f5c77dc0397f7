// Shades maps of a material so that color and gloss are visible.
#pragma once

#include <array>
#include <vector>

#include "renderer/brdf.hpp"
#include "report/picture_grid.hpp"

namespace remapc {

using DisplayColor = std::array<float, 3>;  // 0 to 1, encoded for a display

// Returns display values. `samples`: the texels of `grid` (samples_of()) or their conversion. The map is
// shown on a cushion from above, whose normals lean outwards by up to 35 degrees at the ends of the longer
// side. A key light from the upper left and a weaker light from the lower right produce highlights as wide as
// the material's lobe; uniform surroundings give metals their color. Texels that are not finite are black.
Image shaded_map(const PictureGrid& grid, const std::vector<remap::WarpTexel>& samples,
                 const BrdfModel& model);

// The color of a texel at the center of the cushion, for points in plots.
DisplayColor shaded_color(const remap::WarpTexel& texel, const BrdfModel& model);

}  // namespace remapc
