// Images of assets: bytes of files in, pixels out, and back. The core knows no image library; who calls it
// brings one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "remap/pixels.hpp"

namespace remap {

// Whole numbers as the file stores them, without any curve applied and not multiplied by alpha.
struct ImagePixels {
  std::size_t width = 0, height = 0;
  std::size_t channels = 0;            // 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  PixelType type = PixelType::kUint8;  // or kUint16, in the order of this machine
  std::vector<std::byte> bytes;        // interleaved, row-major from the top

  std::size_t texel_bytes() const noexcept { return channels * byte_count(type); }
  bool has_alpha() const noexcept { return channels % 2 == 0; }
  bool is_grey() const noexcept { return channels < 3; }
};

// `64x32`
inline std::string size_text(const ImagePixels& pixels) {
  return std::to_string(pixels.width) + "x" + std::to_string(pixels.height);
}

// QuantizationTable of zlib for PNG files: half the time of 6, which is usual elsewhere, and files a tenth
// larger; and the smallest of several tries.
inline constexpr int kUsualPngLevel = 3, kSmallestPngLevel = 9;

class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  // Palettes are expanded. Throws kInput, beginning with `context`, for bytes that are no image that it
  // reads.
  virtual ImagePixels decode(std::string_view bytes, const std::string& context) const = 0;
  // A PNG file. `level`: 1 (fast) to 9 (small). Throws kOutput.
  virtual std::string encode_png(const ImagePixels& pixels, int level) const = 0;
  // A JPEG file, of 8 bits and without alpha. `quality`: 1 to 100. Throws kOutput.
  virtual std::string encode_jpeg(const ImagePixels& pixels, int quality) const = 0;
};

}  // namespace remap
