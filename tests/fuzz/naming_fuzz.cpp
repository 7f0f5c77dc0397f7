// Files of naming habits.
#include "discovery/naming.hpp"
#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return remap::read_or_refuse([&] { remap::parse_naming(remap::text_of(data, size), "names.json"); });
}
