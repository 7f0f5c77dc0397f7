// This file brings the maps of a material onto one grid, if they have different KHR_texture_transform.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "assets/document/asset.hpp"

namespace remap {

struct TextureTransform {
  double offset[2] = {0.0, 0.0};
  double scale[2] = {1.0, 1.0};
  double rotation = 0.0;  // in radians
  bool operator==(const TextureTransform&) const = default;
};

// A TextureGrid is the size of a texture in texels, and its place.
struct TextureGrid {
  std::size_t width = 0, height = 0;
  TextureTransform transform;
};

// A CommonGrid is the grid for all textures. `of` is the index of the texture that lies as the grid does.
struct CommonGrid {
  std::size_t of = 0;
  TextureGrid grid;
  bool repeats = true;  // false if coordinates of the mesh must be within 0 to 1
};

// Chooses the grid of the texture that repeats least, if all other textures repeat in it an integer number of
// times. Otherwise, chooses the grid of a texture that covers coordinates from 0 to 1 without a repeat.
// Returns nothing if there is no such texture. Texels of the grid are as small as the smallest texels of any
// texture. A side has at most 4096 texels, or as many as the largest image.
std::optional<CommonGrid> common_grid(const std::vector<TextureGrid>& textures);

// Returns `map` on another grid. Each texel gets the value of the map at the same texture coordinates (before
// both transforms), bilinear and repeated. `transfer` is the curve of all channels except alpha, so that they
// are filtered in linear light. Throws kInput if the transform of the grid has no inverse.
ImagePixels baked(const ImagePixels& map, Transfer transfer, const TextureTransform& transform,
                  const TextureGrid& grid);

}  // namespace remap
