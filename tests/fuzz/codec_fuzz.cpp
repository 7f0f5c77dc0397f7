// This target decodes images that assets embed or refer to, with the image module of the programs. It encodes
// them as PNG and decodes them again. They must not change.
#include "fuzz/fuzz.hpp"
#include "texture/image_library.hpp"

namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 16;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const remap::ImageCodec& codec = remap::image_library().codec();
  return remap::read_or_refuse([&] {
    const remap::ImagePixels pixels = codec.decode(remap::text_of(data, size), "image");
    if (pixels.bytes.size() != pixels.width * pixels.height * pixels.texel_bytes()) std::abort();
    if (pixels.bytes.size() > kMostBytes) return;  // encoding them would take too long
    const remap::ImagePixels again =
        codec.decode(codec.encode_png(pixels, remap::kSmallestPngLevel), "again");
    if (again.bytes != pixels.bytes || again.type != pixels.type) std::abort();
    if (pixels.type == remap::PixelType::kUint8 && !pixels.has_alpha()) codec.encode_jpeg(pixels, 85);
  });
}
