// This target reads glTF (text and binary) and MTL files, as `texremap check` does.
#include "check/material.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = remap::fuzz_file(data, size);
  remap::FoundMaterials found;
  if (const int answer = remap::read_or_refuse([&] { remap::add_mtl(file, found); })) return answer;
  return remap::read_or_refuse([&] { remap::add_gltf(file, found); });
}
