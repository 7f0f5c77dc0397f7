// This file reports a warp in pictures. They show both materials, their strokes and appearance spaces, and
// the result (An et al. 2011, figure 1). Pictures of maps of any size have texels that are scaled to one size
// and shaded so that color and gloss are visible.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "look/brdf.hpp"
#include "look/image.hpp"
#include "remap/warp.hpp"
#include "warp/material.hpp"
#include "warp/warp.hpp"

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

// A WarpReport holds texts, and pictures in display values. The longer side of a map, and the width of a
// space, is 512 pixels.
struct WarpReport {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  // name and value
  std::vector<std::string> warnings;
  std::size_t stroke_count = 0;
  Image source, target, result;          // shaded by shaded_map()
  Image source_strokes, target_strokes;  // the dimmed maps with the strokes in their colors
  // These show the first two coordinates. Points have the colors of texels. Points of strokes are larger and
  // have the colors of the strokes.
  Image source_space, target_space;
  Image before, after;  // the source's points before and after the warp, over the template's points (grey)
};

// Draws the pictures, and leaves the texts to the caller. The result comes from the compiled converter. Draws
// at most 16384 points of each material and 512 points of each stroke.
WarpReport warp_report(const WarpMaterial& source, const WarpMaterial& target,
                       const std::vector<StrokePair>& strokes, const WarpFit& fit);

// Throws kUsage if the name does not end with .html.
void require_report_path(const std::filesystem::path& path);

// Writes one HTML file with embedded pictures. Throws kOutput.
void write_warp_report(const std::filesystem::path& path, const WarpReport& report);

}  // namespace remap
