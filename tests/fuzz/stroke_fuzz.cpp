// This target reads images of strokes, and boxes of the command line, for maps of 4 x 4 texels.
#include <cstdlib>

#include "core/plain_text.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "texture/image_library.hpp"
#include "warp/strokes.hpp"

namespace {

constexpr std::size_t kLongestBox = 200, kTexels = 16;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A module that cannot be loaded would otherwise look like images that are refused.
  (void)remap::image_library();
  remap::WarpMaterial maps;
  maps.name = "maps";
  maps.width = maps.height = 4;
  const std::string_view text = remap::text_of(data, size);
  const auto require = [](const std::vector<std::uint32_t>& stroke) {
    if (stroke.empty()) std::abort();
    for (const std::uint32_t texel : stroke)
      if (texel >= kTexels) std::abort();
  };
  // A box is an argument. The programs print arguments as plain text.
  if (size <= kLongestBox && remap::is_plain_text(text))
    return remap::read_or_refuse([&] { require(remap::box_stroke(std::string(text), maps)); });
  return remap::read_or_refuse([&] { require(remap::read_stroke(remap::fuzz_file(data, size), maps)); });
}
