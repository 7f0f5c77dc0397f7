// This file declares how images of assets are decoded and encoded. The core has no image library; the caller
// provides one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "remap/pixels.hpp"

namespace remap {

// An ImagePixels holds integers as the file stores them. No curve and no alpha is applied.
struct ImagePixels {
  std::size_t width = 0, height = 0;
  std::size_t channels = 0;            // 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  PixelType type = PixelType::kUint8;  // or kUint16, in the order of this machine
  std::vector<std::byte> bytes;        // interleaved, row-major from the top

  std::size_t texel_bytes() const noexcept { return channels * byte_count(type); }
  bool has_alpha() const noexcept { return channels % 2 == 0; }
  bool is_grey() const noexcept { return channels < 3; }
};

// Returns a text such as `64x32`.
inline std::string size_text(const ImagePixels& pixels) {
  return std::to_string(pixels.width) + "x" + std::to_string(pixels.height);
}

// These are zlib levels of PNG files. The usual level takes half the time of level 6, which most programs
// use, and makes files a tenth larger. The smallest level is only for images of which several versions are
// tried.
inline constexpr int kUsualPngLevel = 3, kSmallestPngLevel = 9;

class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  // Decodes an image and expands palettes. Throws kInput, beginning with `context`, for bytes that are not an
  // image.
  virtual ImagePixels decode(std::string_view bytes, const std::string& context) const = 0;
  // Returns a PNG file. `level` is 1 (fast) to 9 (small). Throws kOutput.
  virtual std::string encode_png(const ImagePixels& pixels, int level) const = 0;
  // Returns a JPEG file, with 8 bits and without alpha. `quality` is 1 to 100. Throws kOutput.
  virtual std::string encode_jpeg(const ImagePixels& pixels, int quality) const = 0;
};

}  // namespace remap
