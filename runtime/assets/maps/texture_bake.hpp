// Maps of one material whose KHR_texture_transform differ, on one grid.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "assets/document/image_codec.hpp"
#include "remap/model.hpp"

namespace remap {

// KHR_texture_transform.
struct TextureTransform {
  double offset[2] = {0.0, 0.0};
  double scale[2] = {1.0, 1.0};
  double rotation = 0.0;  // radians
  bool operator==(const TextureTransform&) const = default;
};

// The texels of a texture, and where they lie.
struct TextureGrid {
  std::size_t width = 0, height = 0;
  TextureTransform transform;
};

// A texture that is to be brought onto one grid with others.
struct PlacedTexture {
  std::size_t width = 0, height = 0;  // of its image, in texels
  TextureTransform transform;
};

// The grid for all: `of` is the texture whose place it has.
struct CommonGrid {
  std::size_t of = 0;
  TextureGrid grid;
  bool repeats = true;  // else it holds only where texture coordinates of the mesh are within 0 to 1
};

// The place of the texture that repeats least, in which each other one repeats a whole number of times, with
// texels as fine as the finest, up to 4096 a side or the largest image. Without such a texture, the place of
// one that covers texture coordinates from 0 to 1 without a repeat. None where there is neither.
std::optional<CommonGrid> common_grid(const std::vector<PlacedTexture>& textures);

// `map` as it would lie on another grid: for each texel, the value of the map at the same texture coordinates
// before both transforms. Bilinear and repeated. `transfer`: of all channels but alpha, which are filtered in
// linear light. Throws kInput where the transform of the grid has no inverse.
ImagePixels baked(const ImagePixels& map, Transfer transfer, const TextureTransform& transform,
                  const TextureGrid& grid);

}  // namespace remap
