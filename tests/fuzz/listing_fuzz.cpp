// Manifests of texremap, of sets and of assets.
#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "texremap/manifest.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = remap::fuzz_file(data, size);
  return remap::read_or_refuse([&] { remap::read_manifest(file, {1, 2}); });
}
