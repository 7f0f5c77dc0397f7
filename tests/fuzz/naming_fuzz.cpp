// This target reads files of naming conventions.
#include "fuzz/fuzz.hpp"
#include "sets/naming.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return remap::read_or_refuse([&] { remap::parse_naming(remap::text_of(data, size), "names.json"); });
}
