// Maps of one material whose KHR_texture_transform differ, on one grid.
#pragma once

#include <cstddef>

#include "assets/gltf_images.hpp"
#include "assets/image_codec.hpp"
#include "remap/model.hpp"

namespace remap {

// The texels of a texture, and where they lie.
struct TextureGrid {
  std::size_t width = 0, height = 0;
  TextureTransform transform;
};

// `map` as it would lie on another grid: for each texel, the value of the map at the same texture coordinates
// before both transforms. Bilinear and repeated. `transfer`: of all channels but alpha, which are filtered in
// linear light. Throws kInput where the transform of the grid has no inverse.
ImagePixels baked(const ImagePixels& map, Transfer transfer, const TextureTransform& transform,
                  const TextureGrid& grid);

}  // namespace remap
