// This file describes conversions of assets: files with materials, such as glTF and MTL. Options and results
// have the same form for every format. The core has no image library; the caller provides one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/document/asset_uri.hpp"
#include "assets/document/mtl_document.hpp"
#include "core/json_spans.hpp"
#include "core/plain_text.hpp"
#include "remap/converter.hpp"
#include "remap/model.hpp"
#include "remap/pixels.hpp"
#include "remap/workflow.hpp"

namespace remap {

// An ImagePixels holds integers as the file stores them. No curve and no alpha is applied.
struct ImagePixels {
  std::size_t width = 0, height = 0;
  std::size_t channels = 0;            // 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  PixelType type = PixelType::kUint8;  // or kUint16, in the order of this machine
  std::vector<std::byte> bytes;        // interleaved, row-major from the top

  std::size_t texel_bytes() const noexcept { return channels * byte_count(type); }
  bool has_alpha() const noexcept { return channels % 2 == 0; }
  bool is_grey() const noexcept { return channels < 3; }
};

// Returns a text such as `64x32`.
inline std::string size_text(const ImagePixels& pixels) {
  return std::to_string(pixels.width) + "x" + std::to_string(pixels.height);
}

// These are zlib levels of PNG files. The usual level takes half the time of level 6, which most programs
// use, and makes files a tenth larger. The smallest level is only for images of which several versions are
// tried.
inline constexpr int kUsualPngLevel = 3, kSmallestPngLevel = 9;

class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  // Decodes an image and expands palettes. Throws kInput, beginning with `context`, for bytes that are not an
  // image.
  virtual ImagePixels decode(std::string_view bytes, const std::string& context) const = 0;
  // Returns a PNG file. `level` is 1 (fast) to 9 (small). Throws kOutput.
  virtual std::string encode_png(const ImagePixels& pixels, int level) const = 0;
  // Returns a JPEG file, with 8 bits and without alpha. `quality` is 1 to 100. Throws kOutput.
  virtual std::string encode_jpeg(const ImagePixels& pixels, int quality) const = 0;
};

// A ByteSource gives bytes of a file or of memory, and reads them on demand.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  virtual std::uint64_t size() const = 0;
  // Reads `count` bytes from `begin`, which lie within size(). Throws kInput if they cannot be read.
  virtual std::string read(std::uint64_t begin, std::size_t count) const = 0;
};

// Reads from `bytes`, which must outlive this object.
class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::string bytes) : bytes_(std::move(bytes)) {}
  std::uint64_t size() const override { return bytes_.size(); }
  std::string read(std::uint64_t begin, std::size_t count) const override {
    return bytes_.substr(begin, count);
  }

 private:
  std::string bytes_;
};

// Opens a file that belongs to an asset, by its path relative to the asset. Throws kInput, also for a path
// that leads out of the allowed folders.
using OpenAssetFile = std::function<std::unique_ptr<ByteSource>(const std::string& path)>;

// An AssetResources opens files that belong to an asset, and provides what its images need.
class AssetResources {
 public:
  virtual ~AssetResources() = default;
  // Does what OpenAssetFile describes.
  virtual std::unique_ptr<ByteSource> open(const std::string& path) const = 0;
  virtual const ImageCodec& codec() const = 0;
  // Returns the image at a larger size, which must be at least its own size in both directions. It is
  // interpolated bilinearly in linear light. All channels except alpha are in sRGB.
  virtual ImagePixels enlarged(const ImagePixels& pixels, std::size_t width, std::size_t height) const = 0;
  // Returns the prefix of the names of new images. It is set if another asset may add the same name.
  virtual std::string image_prefix() const { return ""; }
};

// An AssetTarget is the form that materials are converted to.
enum class AssetTarget {
  kMetalRough,  // metallic-roughness
  kSpecGloss,   // KHR_materials_pbrSpecularGlossiness; core stays in the file for other viewers
};

// A DielectricExtensions is what metal-rough materials do with KHR_materials_specular and _ior.
enum class DielectricExtensions {
  kKept,     // new materials use core only, and others keep their extensions
  kWritten,  // new materials use them
  kFolded,   // core replaces them in all materials, which needs AssetTarget::kMetalRough
};
// The first is the default, which has no word.
inline constexpr NamedValues<DielectricExtensions, 2> kDielectricExtensions = {
    {{DielectricExtensions::kWritten, "write"}, {DielectricExtensions::kFolded, "fold"}}};

struct AssetOptions {
  DielectricExtensions extensions = DielectricExtensions::kKept;
  double prior = kCleanPrior;  // prior of the projection (docs/workflows.md)
  InstructionSet instructions = best_instruction_set();
  // Enlarges images of a material to the size of its largest image, and moves maps with different
  // KHR_texture_transform onto the grid of the first.
  bool resamples = false;
  AssetTarget target = AssetTarget::kMetalRough;
  // Removes image bytes and texture extensions that only the converted materials used.
  bool compacts = false;
  std::optional<MtlMaker> mtl_maker = std::nullopt;  // if unset, detected from the file
  // This is the quality, 1 to 100, of new color images: JPEG, unless they have alpha or come from a color map
  // that is not JPEG. If it is missing, new images are PNG.
  std::optional<int> jpeg_quality = std::nullopt;
  // This is the compression level of new PNG images. If it is missing, the usual level applies.
  std::optional<int> png_level = std::nullopt;

  bool writes_extensions() const { return extensions == DielectricExtensions::kWritten; }
  bool folds_extensions() const { return extensions == DielectricExtensions::kFolded; }
};

enum class MaterialState {
  kUntouched,  // nothing to convert
  kConverted,
  kFailed,  // stays unchanged
};
inline constexpr NamedValues<MaterialState, 3> kMaterialStates = {{{MaterialState::kUntouched, "untouched"},
                                                                   {MaterialState::kConverted, "converted"},
                                                                   {MaterialState::kFailed, "failed"}}};

// A MaterialFactor is `base_color` with three numbers, or for example `metallic` with one.
struct MaterialFactor {
  std::string name;
  std::vector<double> values;
};

struct AssetMaterial {
  std::size_t index = 0;  // index of the material in the file
  std::string name;       // name of the material in the file; may be empty
  MaterialState state = MaterialState::kUntouched;
  std::vector<MaterialFactor> factors;  // set for a converted material without varying maps
  double residual = 0.0;                // Parameter::kResidual; for maps the root of its mean square
  std::string becomes;                  // `base color 0.2 0.3 0.4, metallic 0, roughness 0.75`
  std::vector<std::string> warnings;    // messages without the name of the material
  std::string failure;

  // Returns a text such as `material 3 "Paint"`, safe for a message.
  std::string title() const {
    return "material " + std::to_string(index) + (name.empty() ? "" : " \"" + plain(name, 80) + "\"");
  }
};

inline std::size_t count_of(const std::vector<AssetMaterial>& materials, MaterialState state) {
  return static_cast<std::size_t>(std::ranges::count(materials, state, &AssetMaterial::state));
}

// An AssetPiece is a part of a result: `bytes`, or a range of the source if `bytes` is empty.
struct AssetPiece {
  std::string bytes;
  std::uint64_t begin = 0, end = 0;
};

// A NewResource is a new file next to the result.
struct NewResource {
  std::string path;  // relative path
  std::string bytes;
};

// An AssetResource is a URI of a file outside the asset.
struct AssetResource {
  // This is the place in the file, such as `/images/2/uri`. To save time, this is set only for the first URI
  // that is absolute or leads out of the folder.
  std::string where;
  std::string path;  // relative to the asset, without percent codes; for kRemote, the address
  UriKind kind = UriKind::kFile;
};

struct AssetConversion {
  std::vector<AssetMaterial> materials;
  std::vector<std::string> warnings;     // warnings about the file
  std::string text;                      // text of the file after the edits, as UTF-8
  std::vector<TextSpan> touched;         // bytes of the text that were replaced or removed
  bool changed = false;                  // true if a material was converted
  std::vector<AssetPiece> pieces;        // pieces of the converted file; empty if nothing was converted
  std::vector<NewResource> files;        // new images
  std::vector<AssetResource> resources;  // files that the asset uses, each once, in the order of the text

  std::size_t count(MaterialState state) const { return count_of(materials, state); }
};

}  // namespace remap
