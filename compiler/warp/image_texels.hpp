// This file reads whole images.
#pragma once

#include <cstddef>
#include <vector>

#include "texture/image_reader.hpp"

namespace remap {

// Returns all rows of an image in its layout. Throws the errors of read_rows().
inline std::vector<std::byte> texels_of(ImageReader& image) {
  const ImageLayout& layout = image.layout();
  std::vector<std::byte> texels(static_cast<std::size_t>(layout.height) * layout.row_bytes());
  image.read_rows(0, layout.height, texels.data());
  return texels;
}

// Returns the stored values of one channel, row-major from the top. Integers are scaled to 0 to 1.
inline std::vector<float> channel_values(const ImageLayout& layout, std::size_t channel,
                                         const std::vector<std::byte>& texels) {
  const Channel& own = layout.channels[channel];
  std::vector<float> values(static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height));
  load_values(own.type, texels.data() + own.offset, layout.texel_bytes, values.size(), values.data());
  return values;
}

}  // namespace remap
