// Images that are read whole.
#pragma once

#include <cstddef>
#include <vector>

#include "texture/image_io.hpp"

namespace remapc {

// All rows of an image, as its layout has them. Throws as read_rows() does.
inline std::vector<std::byte> texels_of(remap::ImageReader& image) {
  const remap::ImageLayout& layout = image.layout();
  std::vector<std::byte> texels(static_cast<std::size_t>(layout.height) * layout.row_bytes());
  image.read_rows(0, layout.height, texels.data());
  return texels;
}

}  // namespace remapc
