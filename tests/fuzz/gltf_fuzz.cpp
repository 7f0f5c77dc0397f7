// Whole glTF files, text and binary, as `texremap convert` edits them. What comes out is read again, and has
// nothing left to convert.
#include "assets/gltf_asset.hpp"
#include "fuzz/fuzz.hpp"

namespace {

std::string written(const std::string& bytes, const remap::AssetConversion& conversion) {
  std::string result;
  for (const remap::AssetPiece& piece : conversion.pieces)
    result += piece.bytes.empty() ? bytes.substr(piece.begin, piece.end - piece.begin) : piece.bytes;
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(remap::text_of(data, size));
  return remap::read_or_refuse([&] {
    for (const remap::MaterialProfile profile :
         {remap::MaterialProfile::kCore, remap::MaterialProfile::kExtensions}) {
      const remap::SpecGlossOptions options{profile, remap::kCleanPrior, remap::InstructionSet::kBaseline};
      const remap::AssetConversion once = remap::convert_asset(remap::MemorySource(bytes), "file", options);
      if (!once.result.changed) continue;
      const std::string again = written(bytes, once);
      const remap::AssetConversion twice = remap::convert_asset(remap::MemorySource(again), "file", options);
      if (twice.result.changed) std::abort();
    }
  });
}
