// How maps of any size become pictures of one size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/image.hpp"
#include "warp/compiled_warp.hpp"

namespace remapc {

// Which texels of a map a picture shows: `samples` x `samples` of them a pixel, so that fine patterns are
// averaged as they are lit, never before.
struct PictureGrid {
  int width = 0, height = 0;          // of the picture
  int samples = 1;                    // along each side of a pixel
  std::vector<std::uint32_t> texels;  // indices into the map, row by row, (width samples) x (height samples)

  std::size_t sample_width() const noexcept { return static_cast<std::size_t>(width * samples); }
};

// Of a map of `width` x `height` texels, both above 0: its longer side is `side` pixels. Texels of small maps
// are repeated; a pixel of a large one shows nine texels at most.
PictureGrid picture_grid(std::size_t width, std::size_t height, int side);

// The texels that the grid asks for.
std::vector<remap::WarpTexel> samples_of(const PictureGrid& grid,
                                         const std::vector<remap::WarpTexel>& texels);

// A picture of one color.
Image blank_picture(int width, int height, float grey);

// Rows of pictures on light paper, with gaps. Columns are as wide as the widest picture, rows as high as
// their highest; pictures lie in the middle of their cells.
Image sheet_of(const std::vector<std::vector<Image>>& rows);

}  // namespace remapc
