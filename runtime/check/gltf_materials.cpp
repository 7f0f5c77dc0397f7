// Materials of glTF 2.0 files (.gltf, .glb), with the extensions of Khronos that say what a surface reflects.
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/asset_uri.hpp"
#include "assets/gltf_bytes.hpp"
#include "assets/gltf_container.hpp"
#include "assets/gltf_extensions.hpp"
#include "assets/json_spans.hpp"
#include "check/material.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/plain_text.hpp"
#include "sets/folder_walk.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kLargestAsset = std::uintmax_t{4} << 30;  // as much as a glb can say

// A place of a texture in a material.
struct TexturePlace {
  std::string_view object;   // of the material, or the extension that holds it; empty for the material itself
  std::string_view texture;  // the field with the index of the texture
  std::string_view factor;   // the number or color that it is multiplied by
  Role role;
  Channels channels;
  bool zero_is_default = false;  // without a factor the texture is multiplied by 0
};

constexpr std::array<TexturePlace, 16> kPlaces = {{
    {kCoreMember, "baseColorTexture", "baseColorFactor", Role::kBaseColor, Channels::kRgb},
    {kCoreMember, "metallicRoughnessTexture", "roughnessFactor", Role::kRoughness, Channels::kGreen},
    {kCoreMember, "metallicRoughnessTexture", "metallicFactor", Role::kMetallic, Channels::kBlue},
    {"", "normalTexture", "", Role::kNormal, Channels::kRgb},
    {"", "occlusionTexture", "", Role::kOcclusion, Channels::kRed},
    {"", "emissiveTexture", "emissiveFactor", Role::kEmissive, Channels::kRgb, true},
    {kSpecGlossExtension, "diffuseTexture", "diffuseFactor", Role::kDiffuse, Channels::kRgb},
    {kSpecGlossExtension, "specularGlossinessTexture", "specularFactor", Role::kSpecular, Channels::kRgb},
    {kSpecGlossExtension, "specularGlossinessTexture", "glossinessFactor", Role::kGlossiness,
     Channels::kAlpha},
    {kSpecularExtension, "specularTexture", "specularFactor", Role::kOther, Channels::kAlpha},
    {kSpecularExtension, "specularColorTexture", "specularColorFactor", Role::kOther, Channels::kRgb},
    {"KHR_materials_clearcoat", "clearcoatTexture", "clearcoatFactor", Role::kOther, Channels::kRed, true},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", "clearcoatRoughnessFactor", Role::kOther,
     Channels::kGreen, true},
    {"KHR_materials_sheen", "sheenColorTexture", "sheenColorFactor", Role::kOther, Channels::kRgb, true},
    {"KHR_materials_sheen", "sheenRoughnessTexture", "sheenRoughnessFactor", Role::kOther, Channels::kAlpha,
     true},
    {"KHR_materials_transmission", "transmissionTexture", "transmissionFactor", Role::kTransmission,
     Channels::kRed, true},
}};

// A whole file in memory.
class WholeFile final : public ByteSource {
 public:
  explicit WholeFile(const fs::path& file) : bytes_(read_file(file, kLargestAsset)) {}
  std::uint64_t size() const override { return bytes_.size(); }
  std::string read(std::uint64_t begin, std::size_t count) const override {
    return bytes_.substr(begin, count);
  }

 private:
  std::string bytes_;
};

class FilesBeside final : public AssetFiles {
 public:
  explicit FilesBeside(fs::path folder) : folder_(std::move(folder)) {}
  std::unique_ptr<ByteSource> open(const std::string& path) const override {
    return std::make_unique<WholeFile>(folder_ / path);
  }

 private:
  fs::path folder_;
};

class GltfMaterials {
 public:
  GltfMaterials(const fs::path& file, FoundMaterials& found)
      : file_(file),
        found_(found),
        source_(file),
        beside_(file.parent_path()),
        container_(read_container(source_, shown(file))),
        json_(container_.json, shown(file)),
        bytes_(json_, container_, source_, beside_),
        textures_(json_.root()["textures"].entries()),
        images_(json_.root()["images"].entries()) {}

  void add_all() {
    const std::vector<SpanValue> materials = json_.root()["materials"].entries();
    for (std::size_t i = 0; i < materials.size(); ++i) add(materials[i], i);
  }

 private:
  void add(SpanValue entry, std::size_t index) {
    CheckedMaterial material;
    material.kind = MaterialKind::kGltf;
    material.place = file_;
    const std::optional<std::string> name = entry["name"].text();
    material.name =
        shown(file_) + ": material " + (name ? "\"" + plain(*name) + "\"" : std::to_string(index));
    const SpanValue extensions = entry["extensions"];
    if (extensions.is(SpanKind::kObject))
      for (const SpanValue& extension : extensions.children())
        material.gltf.extensions.insert(extension.key());
    for (const TexturePlace& place : kPlaces) add_use(entry, place, material);
    material.gltf.ior = extensions[kIorExtension]["ior"].number();
    material.gltf.specular_factor = extensions[kSpecularExtension]["specularFactor"].number();
    const SpanValue transmission = extensions["KHR_materials_transmission"];
    material.gltf.transmits = transmission["transmissionFactor"].number().value_or(0.0) > 0.0;
    found_.materials.push_back(std::move(material));
  }

  void add_use(SpanValue entry, const TexturePlace& place, CheckedMaterial& material) {
    SpanValue object = entry;
    if (!place.object.empty())
      object = place.object == kCoreMember ? entry[kCoreMember] : entry["extensions"][place.object];
    const std::optional<std::size_t> texture = object[place.texture]["index"].whole();
    const std::optional<std::size_t> map = texture ? map_of(*texture, material) : std::nullopt;
    if (!map) return;
    MaterialUse use{
        place.role, *map, place.channels, std::string(place.texture), {}, std::string(place.factor), false};
    const SpanValue factor = place.factor.empty() ? SpanValue() : object[place.factor];
    if (!factor && place.zero_is_default) use.factors = {0.0};
    if (factor.number()) use.factors = {*factor.number()};
    const std::vector<SpanValue> numbers = factor.entries();
    for (std::size_t c = 0; c < std::min<std::size_t>(3, numbers.size()); ++c)
      use.factors.push_back(numbers[c].number().value_or(1.0));
    if (place.object == kSpecularExtension) material.gltf.has_specular_map = true;
    material.uses.push_back(std::move(use));
  }

  // The map of a texture, which is added to the material where it is new; none where nothing says where it
  // is.
  std::optional<std::size_t> map_of(std::size_t texture, CheckedMaterial& material) {
    if (texture >= textures_.size()) return std::nullopt;
    const std::optional<std::size_t> image = textures_[texture]["source"].whole();
    if (!image || *image >= images_.size()) return std::nullopt;
    const fs::path file = file_of_image(*image);
    for (std::size_t i = 0; i < material.maps.size(); ++i)
      if (material.maps[i].file == file) return i;
    const bool is_embedded = embedded_.contains(*image);
    material.maps.push_back(
        {file, is_embedded ? image_title(*image) : file.string(),
         is_embedded ? images_[*image]["name"].text().value_or("") : file.filename().string(), nullptr});
    return material.maps.size() - 1;
  }

  std::string image_title(std::size_t image) const {
    return shown(file_) + ": image " + std::to_string(image);
  }

  fs::path file_of_image(std::size_t image) {
    const std::optional<std::string> uri = images_[image]["uri"].text();
    if (uri && uri_kind(*uri) != UriKind::kData) return file_.parent_path() / percent_decoded(*uri);
    if (const auto known = embedded_.find(image); known != embedded_.end()) return known->second;
    const std::string bytes = bytes_of_image(image);
    if (!found_.embedded) found_.embedded = std::make_shared<const ScratchFolder>("texremap-check");
    const std::string extension = bytes.starts_with("\x89PNG")    ? ".png"
                                  : bytes.starts_with("\xff\xd8") ? ".jpg"
                                                                  : ".webp";
    const fs::path file =
        found_.embedded->file(std::to_string(found_.materials.size()) + "_" + file_.stem().string() + "_" +
                              std::to_string(image) + extension);
    write_file(file, bytes, Flush::kNo);
    return embedded_.emplace(image, file).first->second;
  }

  std::string bytes_of_image(std::size_t image) const {
    try {
      return bytes_.of_image(image);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      throw input_error(image_title(image) + ": " + error.what());
    }
  }

  const fs::path& file_;
  FoundMaterials& found_;
  WholeFile source_;
  FilesBeside beside_;
  GltfContainer container_;
  SpannedJson json_;
  GltfBytes bytes_;
  std::vector<SpanValue> textures_, images_;
  std::map<std::size_t, fs::path> embedded_;  // files of images that are part of the asset
};

}  // namespace

void add_gltf(const fs::path& file, FoundMaterials& found) { GltfMaterials(file, found).add_all(); }

}  // namespace remap
