// Scales maps of any size to pictures of one size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "remap/compiled_warp.hpp"
#include "renderer/image.hpp"

namespace remapc {

// The texels of a map that a picture shows: `samples` x `samples` per pixel. Texels are shaded before they
// are averaged.
struct PictureGrid {
  int width = 0, height = 0;  // of the picture
  int samples = 1;            // along each side of a pixel
  std::vector<std::uint32_t>
      texels;  // indices into the map, row-major, (width * samples) x (height * samples)

  std::size_t sample_width() const noexcept { return static_cast<std::size_t>(width * samples); }
};

// Returns the grid of a picture whose longer side is `side` pixels, for a map of `width` x `height` texels
// (both above 0). Texels of small maps are repeated; a pixel of a large map shows at most nine texels.
PictureGrid picture_grid(std::size_t width, std::size_t height, int side);

// Returns the texels of the grid.
std::vector<remap::WarpTexel> samples_of(const PictureGrid& grid,
                                         const std::vector<remap::WarpTexel>& texels);

// Returns a picture of one grey value.
Image blank_picture(int width, int height, float grey);

// Arranges rows of pictures on a light background, with gaps. Columns are as wide as the widest picture, rows
// as high as their highest picture, and pictures are centered in their cells.
Image sheet_of(const std::vector<std::vector<Image>>& rows);

}  // namespace remapc
