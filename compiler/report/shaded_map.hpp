// This file draws pictures of maps of any size. Texels are scaled to one size and shaded so that color and
// gloss are visible. Strokes are drawn on them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "look/brdf.hpp"
#include "look/image.hpp"
#include "remap/warp.hpp"
#include "warp/material.hpp"

namespace remap {

// A PictureGrid holds the texels of a map that a picture shows: `samples` x `samples` per pixel. Texels are
// shaded before they are averaged.
struct PictureGrid {
  int width = 0, height = 0;  // width and height of the picture
  int samples = 1;            // number of samples along each side of a pixel
  std::vector<std::uint32_t>
      texels;  // indices into the map, row-major, (width * samples) x (height * samples)

  std::size_t sample_width() const noexcept { return static_cast<std::size_t>(width * samples); }
};

// Returns the grid of a picture whose longer side is `side` pixels, for a map of `width` x `height` texels
// (both above 0). Texels of small maps are repeated. A pixel of a large map shows at most nine texels.
PictureGrid picture_grid(std::size_t width, std::size_t height, int side);

std::vector<WarpTexel> samples_of(const PictureGrid& grid, const std::vector<WarpTexel>& texels);

using DisplayColor = std::array<float, 3>;  // 0 to 1, encoded for a display

// Returns display values. `samples` are the texels of `grid` (samples_of()) or their conversion. The map is
// shown on a cushion from above, whose normals lean outwards by up to 35 degrees at the ends of the longer
// side. A key light from the upper left and a weaker light from the lower right produce highlights as wide as
// the material's lobe. Uniform surroundings give metals their color. Texels that are not finite are black.
Image shaded_map(const PictureGrid& grid, const std::vector<WarpTexel>& samples, const BrdfModel& model);

// Returns the color of a texel at the center of the cushion, for points in plots.
DisplayColor shaded_color(const WarpTexel& texel, const BrdfModel& model);

using StrokeSide = std::vector<std::uint32_t> StrokePair::*;

// Returns the color of the stroke with this index. Seven colors are repeated.
const DisplayColor& stroke_color(std::size_t stroke);

// Dims the picture and draws one side of the strokes in their colors. `grid` is the grid of the picture.
Image with_strokes(const Image& picture, const PictureGrid& grid, const std::vector<StrokePair>& strokes,
                   StrokeSide side);

}  // namespace remap
