// This target reads manifests of `remapc build`.
#include "build/manifest.hpp"
#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return remap::read_or_refuse(
      [&] { remap::manifest_from_json(remap::text_of(data, size), "manifest.json"); });
}
