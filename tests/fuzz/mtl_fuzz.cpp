// This target edits MTL files as `texremap convert` does. The result is read again. It has nothing left to
// convert, and holds every byte that was not touched. The same bytes are also read as an OBJ file with that
// MTL file.
#include <optional>

#include "assets/document/text_edits.hpp"
#include "assets/mtl/mtl_asset.hpp"
#include "assets/obj/obj_gltf.hpp"
#include "core/errors.hpp"
#include "fuzz/fuzz.hpp"

namespace {

// A file whose name has `.mtl` is the input. Half of the other files are images of four texels made from
// their names.
class MtlFuzzResources final : public remap::AssetResources, public remap::ImageCodec {
 public:
  explicit MtlFuzzResources(const std::string& bytes) : bytes_(bytes) {}

  std::unique_ptr<remap::ByteSource> open(const std::string& path) const override {
    if (path.find(".mtl") != std::string::npos) return std::make_unique<remap::MemorySource>(bytes_);
    if (path.empty() || path.back() % 2 == 0) throw remap::input_error(remap::plain(path) + ": is not there");
    return std::make_unique<remap::MemorySource>(path.size() % 2 == 0 ? "\x89PNG\r\n\x1a\n and more bytes"
                                                                      : "\x01\x02\x03 and twelve more");
  }
  const remap::ImageCodec& codec() const override { return *this; }
  remap::ImagePixels decode(std::string_view bytes, const std::string& place) const override {
    if (bytes.size() < 16) throw remap::input_error(place + ": is no image");
    const std::size_t channels = place.size() % 4 + 1;
    remap::ImagePixels pixels{2, 2, channels, remap::PixelType::kUint8, {}};
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
    return std::string(pixels.bytes.size(), 'j');
  }

 private:
  const std::string& bytes_;
};

void require(bool holds) {
  if (!holds) std::abort();
}

void edit_twice(const std::string& bytes, const remap::AssetOptions& options,
                const remap::AssetResources& resources) {
  const remap::AssetConversion once =
      remap::convert_mtl(remap::MemorySource(bytes), "file", options, &resources);
  const std::string text = remap::utf8_text(remap::MemorySource(bytes), "file");
  require(once.changed || once.text == text);
  // A material that failed may find an image that another material made.
  if (once.count(remap::MaterialState::kFailed) > 0) return;
  const remap::AssetConversion twice = remap::convert_mtl(
      remap::MemorySource(once.changed ? once.pieces.front().bytes : bytes), "file", options, &resources);
  require(twice.text == once.text);
  require(!twice.changed && twice.materials.size() == once.materials.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(remap::text_of(data, size));
  const MtlFuzzResources resources(bytes);
  const remap::AssetOptions core{remap::DielectricExtensions::kKept, remap::kCleanPrior,
                                 remap::InstructionSet::kBaseline, true};
  remap::AssetOptions extensions = core;
  extensions.extensions = remap::DielectricExtensions::kWritten;
  (void)remap::read_or_refuse([&] { edit_twice(bytes, core, resources); });
  (void)remap::read_or_refuse(
      [&] { (void)remap::gltf_of_obj(remap::MemorySource(bytes), "file", core, resources); });
  (void)remap::read_or_refuse(
      [&] { (void)remap::obj_resources(remap::MemorySource(bytes), "file", resources); });
  return remap::read_or_refuse([&] {
    (void)remap::gltf_of_obj(remap::MemorySource(bytes), "file", extensions, resources, "file.bin");
  });
}
