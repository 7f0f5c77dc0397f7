// Images of strokes, for maps of 4 x 4 texels.
//
// Two claims of a header are left out, because the libraries reserve memory for them before anybody can ask:
// rows of OpenEXR (there is no such file in the corpus), and chunks of PNG that are longer than the file,
// which libpng even fills.
#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "warp/strokes.hpp"

namespace {

bool has_endless_chunk(std::string_view png) {
  constexpr std::size_t kSignature = 8, kHead = 8, kCheck = 4;
  if (!png.starts_with("\x89PNG")) return false;
  for (std::size_t at = kSignature; at + kHead <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<std::uint8_t>(png[at + i]);
    if (length > png.size()) return true;
    at += kHead + length + kCheck;
  }
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (has_endless_chunk(remap::text_of(data, size))) return -1;  // not kept
  const remap::MapFrame frame{"maps", 4, 4};
  return remap::read_or_refuse([&] { remap::read_stroke(remap::fuzz_file(data, size), frame); });
}
