#include "texture/enlarged_pixels.hpp"

#include <cstring>
#include <utility>
#include <vector>

#include "texture/resampled_rows.hpp"

namespace remap {

ImagePixels enlarged_pixels(const ImagePixels& pixels, std::size_t width, std::size_t height) {
  ImageLayout stored;
  stored.width = static_cast<int>(pixels.width);
  stored.height = static_cast<int>(pixels.height);
  std::vector<Transfer> transfers(pixels.channels, Transfer::kSrgb);
  if (pixels.has_alpha()) transfers.back() = Transfer::kLinear;
  for (std::size_t c = 0; c < pixels.channels; ++c)
    stored.channels.push_back({std::string(1, "RGBA"[c]), pixels.type, c * byte_count(pixels.type)});
  stored.texel_bytes = pixels.texel_bytes();
  ResampledRows rows(stored, static_cast<int>(width), static_cast<int>(height), std::move(transfers));
  const auto read_stored = [&](int first, int count, std::byte* texels) {
    const std::size_t row = pixels.width * pixels.texel_bytes();
    std::memcpy(texels, pixels.bytes.data() + static_cast<std::size_t>(first) * row,
                static_cast<std::size_t>(count) * row);
  };
  ImagePixels result{width, height, pixels.channels, pixels.type, {}};
  result.bytes.resize(width * height * result.texel_bytes());
  std::vector<float> values(width * pixels.channels);
  for (std::size_t y = 0; y < height; ++y) {
    rows.read(static_cast<int>(y), 1, reinterpret_cast<std::byte*>(values.data()), read_stored);
    (void)store_values(result.type, values.data(), values.size(),
                       result.bytes.data() + y * width * result.texel_bytes(), byte_count(result.type));
  }
  return result;
}

}  // namespace remap
