// Reads whole images.
#pragma once

#include <cstddef>
#include <vector>

#include "texture/image_io.hpp"

namespace remapc {

// Returns all rows of an image in its layout. Throws the errors of read_rows().
inline std::vector<std::byte> texels_of(remap::ImageReader& image) {
  const remap::ImageLayout& layout = image.layout();
  std::vector<std::byte> texels(static_cast<std::size_t>(layout.height) * layout.row_bytes());
  image.read_rows(0, layout.height, texels.data());
  return texels;
}

}  // namespace remapc
