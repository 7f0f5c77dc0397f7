// Images of strokes, and boxes as the command line has them, for maps of 4 x 4 texels.
#include "core/plain_text.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "warp/strokes.hpp"

namespace {

constexpr std::size_t kLongestBox = 200;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const remap::MapFrame frame{"maps", 4, 4};
  const std::string_view text = remap::text_of(data, size);
  // A box is an argument, which the programs print as plain text.
  if (size <= kLongestBox && remap::is_plain_text(text))
    return remap::read_or_refuse([&] { remap::box_stroke(std::string(text), frame); });
  return remap::read_or_refuse([&] { remap::read_stroke(remap::fuzz_file(data, size), frame); });
}
