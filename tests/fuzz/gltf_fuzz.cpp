// This target edits whole glTF files, text and binary, as `texremap convert` does. The result is read again.
// It has nothing left to convert unless a material failed.
#include "assets/gltf/gltf_asset.hpp"
#include "core/errors.hpp"
#include "fuzz/fuzz.hpp"

namespace {

// Every image is four texels made from its first bytes. There are no files.
class FuzzResources final : public remap::AssetResources, public remap::ImageCodec {
 public:
  std::unique_ptr<remap::ByteSource> open(const std::string& path) const override {
    throw remap::input_error(remap::plain(path) + ": is not there");
  }
  const remap::ImageCodec& codec() const override { return *this; }
  remap::ImagePixels decode(std::string_view bytes, const std::string& place) const override {
    if (bytes.size() < 16) throw remap::input_error(place + ": is no image");
    remap::ImagePixels pixels{2, 2, static_cast<std::size_t>(bytes[0] & 3) + 1, remap::PixelType::kUint8, {}};
    pixels.bytes.resize(4 * pixels.channels);
    for (std::size_t i = 0; i < pixels.bytes.size(); ++i) pixels.bytes[i] = static_cast<std::byte>(bytes[i]);
    return pixels;
  }
  remap::ImagePixels enlarged(const remap::ImagePixels& pixels, std::size_t, std::size_t) const override {
    return pixels;
  }
  std::string encode_png(const remap::ImagePixels& pixels, int) const override {
    return std::string(pixels.bytes.size(), 'x');
  }
  std::string encode_jpeg(const remap::ImagePixels& pixels, int) const override {
    return "\xff\xd8" + encode_png(pixels, remap::kUsualPngLevel);
  }
};

std::string written(const std::string& bytes, const remap::AssetConversion& conversion) {
  std::string result;
  for (const remap::AssetPiece& piece : conversion.pieces)
    result += piece.bytes.empty() ? bytes.substr(piece.begin, piece.end - piece.begin) : piece.bytes;
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(remap::text_of(data, size));
  const FuzzResources resources;
  remap::AssetOptions core;
  core.instructions = remap::InstructionSet::kBaseline;
  core.resamples = true;
  remap::AssetOptions exact = core, compact = core, specgloss = core, folded = core;
  exact.extensions = remap::DielectricExtensions::kWritten;
  compact.compacts = true;
  compact.jpeg_quality = 90;
  specgloss.target = remap::AssetTarget::kSpecGloss;
  specgloss.compacts = true;
  folded.extensions = remap::DielectricExtensions::kFolded;
  return remap::read_or_refuse([&] {
    for (const remap::AssetOptions& options : {core, exact, compact, specgloss, folded}) {
      const remap::AssetConversion once =
          remap::convert_gltf(remap::MemorySource(bytes), "file", options, &resources);
      // An index that pointed to nothing may now point to a new texture.
      if (!once.changed || once.count(remap::MaterialState::kFailed) > 0) continue;
      const std::string again = written(bytes, once);
      const remap::AssetConversion twice =
          remap::convert_gltf(remap::MemorySource(again), "file", options, &resources);
      if (twice.changed) std::abort();
    }
  });
}
