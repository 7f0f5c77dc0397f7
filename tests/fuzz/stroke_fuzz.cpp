// Images of strokes, for maps of 4 x 4 texels. The corpus has no OpenEXR file: that library reserves a row of
// the size that a header claims, which costs nothing but takes the address sanitizer half a minute.
#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "warp/input/strokes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const remapc::MapFrame frame{"maps", 4, 4};
  return remap::read_or_refuse([&] { remapc::read_stroke(remap::fuzz_file(data, size), frame); });
}
