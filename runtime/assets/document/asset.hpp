// Assets: files with materials, such as glTF and MTL. What is asked of a conversion, and what comes of it, in
// the same words for every format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/asset_uri.hpp"
#include "assets/document/image_codec.hpp"
#include "assets/document/mtl_maker.hpp"
#include "core/json_spans.hpp"
#include "remap/converter.hpp"
#include "remap/model.hpp"
#include "remap/workflow.hpp"

namespace remap {

// Bytes that are read where they are needed: of a file or of memory.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  virtual std::uint64_t size() const = 0;
  // `count` bytes from `begin`, which lie within size(). Throws kInput where they cannot be read.
  virtual std::string read(std::uint64_t begin, std::size_t count) const = 0;
};

// `bytes` must outlive it.
class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t size() const override { return bytes_.size(); }
  std::string read(std::uint64_t begin, std::size_t count) const override {
    return std::string(bytes_.substr(begin, count));
  }

 private:
  std::string_view bytes_;
};

// Files beside an asset.
class AssetFiles {
 public:
  virtual ~AssetFiles() = default;
  // A file by its path relative to the asset. Throws kInput, for one that leads out of what may be read, too.
  virtual std::unique_ptr<ByteSource> open(const std::string& path) const = 0;
};

// Files beside an asset, and what its images need.
class AssetResources : public AssetFiles {
 public:
  virtual const ImageCodec& codec() const = 0;
  // The image at a size that is at least its own in both directions: bilinear, in linear light, with all
  // channels but alpha in sRGB.
  virtual ImagePixels enlarged(const ImagePixels& pixels, std::size_t width, std::size_t height) const = 0;
  // The prefix of the names of new images; not empty if another asset may add an image of the same name.
  virtual std::string image_prefix() const { return ""; }
};

// The form that materials are converted to.
enum class AssetTarget {
  kMetalRough,  // metallic-roughness
  kSpecGloss,   // KHR_materials_pbrSpecularGlossiness, with core as its fallback
};

struct AssetOptions {
  bool extensions = false;     // metal-rough with KHR_materials_specular and _ior, instead of core alone
  double prior = kCleanPrior;  // of the projection (docs/workflows.md)
  InstructionSet instructions = best_instruction_set();
  bool enlarges = false;  // images of a material that are smaller than another one
  AssetTarget target = AssetTarget::kMetalRough;
  // KHR_materials_specular and _ior go into core, too; with kMetalRough, and without `extensions`.
  bool folds_specular = false;
  // Removes image bytes and texture extensions that only the converted materials used.
  bool compacts = false;
  bool bakes = false;  // maps of a material whose KHR_texture_transform differ go onto the grid of the first
  std::optional<MtlMaker> mtl_maker = std::nullopt;  // none: as the file says
  // Quality, 1 to 100, of new images of color: JPEG, unless they have alpha or come from a map of color that
  // is none. None for PNG.
  std::optional<int> jpeg_quality = std::nullopt;
  // Level of new PNG images. None for the usual.
  std::optional<int> png_level = std::nullopt;
};

enum class MaterialState {
  kUntouched,  // nothing to convert
  kConverted,
  kFailed,  // stays as it was
};
inline constexpr NamedValues<MaterialState, 3> kMaterialStates = {{{MaterialState::kUntouched, "untouched"},
                                                                   {MaterialState::kConverted, "converted"},
                                                                   {MaterialState::kFailed, "failed"}}};

// `base_color` and three numbers, `metallic` and one.
struct MaterialFactor {
  std::string name;
  std::vector<double> values;
};

// The outcome of a material of the asset.
struct AssetMaterial {
  std::size_t index = 0;  // in the order of the file
  std::string name;       // of the file; may be empty
  MaterialState state = MaterialState::kUntouched;
  std::vector<MaterialFactor> factors;  // of a converted one without maps that vary
  double residual = 0.0;                // Parameter::kResidual; of maps the root of its mean square
  std::string becomes;                  // `base color 0.2 0.3 0.4, metallic 0, roughness 0.75`
  std::vector<std::string> warnings;    // without the name of the material
  std::string failure;

  // `material 3 "Paint"`, fit for a message.
  std::string title() const;
};

std::size_t count_of(const std::vector<AssetMaterial>& materials, MaterialState state);

// A part of a result: `bytes`, or a range of the source if `bytes` is empty.
struct AssetPiece {
  std::string bytes;
  std::uint64_t begin = 0, end = 0;
};

// A new file beside the result.
struct NewResource {
  std::string path;  // relative
  std::string bytes;
};

// A URI of a file that is not in the asset.
struct AssetResource {
  std::string where;  // `/images/2/uri`; only of the first that leads up or is absolute: counting takes time
  std::string path;   // relative to the asset, without percent signs; of kRemote the address
  UriKind kind = UriKind::kFile;
};

struct AssetConversion {
  std::vector<AssetMaterial> materials;
  std::vector<std::string> warnings;     // of the file
  std::string text;                      // edited text of the materials, as UTF-8; the rest is unchanged
  std::vector<TextSpan> touched;         // bytes of the text that were replaced or removed
  bool changed = false;                  // whether a material was converted
  std::vector<AssetPiece> pieces;        // of the converted file; empty where nothing was converted
  std::vector<NewResource> files;        // new images
  std::vector<AssetResource> resources;  // that the asset names, each path once, in the order of the text

  std::size_t count(MaterialState state) const { return count_of(materials, state); }
};

}  // namespace remap
