// Materials of glTF 2.0 files (.gltf, .glb), with the extensions of Khronos that say what a surface reflects.
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/document/asset_uri.hpp"
#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/gltf_bytes.hpp"
#include "assets/gltf/gltf_container.hpp"
#include "assets/gltf/gltf_images.hpp"
#include "check/material.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_spans.hpp"
#include "core/plain_text.hpp"
#include "sets/folder_walk.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr double kUsualIor = 1.5;
constexpr std::uintmax_t kLargestAsset = std::uintmax_t{4} << 30;  // as much as a glb can say

// The effect of a factor of 0 on the texture that it multiplies.
enum class Zero {
  kLost,          // what the texture holds is lost
  kOff,           // the material does without: nothing reads the texture
  kOffByDefault,  // the same, and so it is where there is no factor
  kLostByDefault,
};

// A place of a texture in a material.
struct TexturePlace {
  std::string_view object;   // of the material, or the extension that holds it; empty for the material itself
  std::string_view texture;  // the field with the index of the texture
  std::string_view factor;   // the number or color that it is multiplied by
  Role role;
  Channels channels;
  Zero zero = Zero::kLost;
  bool is_in_texture = false;  // the factor stands beside the index
};

constexpr std::array<TexturePlace, 16> kPlaces = {{
    {kCoreMember, "baseColorTexture", "baseColorFactor", Role::kBaseColor, Channels::kRgb},
    {kCoreMember, "metallicRoughnessTexture", "roughnessFactor", Role::kRoughness, Channels::kGreen},
    {kCoreMember, "metallicRoughnessTexture", "metallicFactor", Role::kMetallic, Channels::kBlue, Zero::kOff},
    {"", "normalTexture", "scale", Role::kNormal, Channels::kRgb, Zero::kOff, true},
    {"", "occlusionTexture", "strength", Role::kOcclusion, Channels::kRed, Zero::kOff, true},
    {"", "emissiveTexture", "emissiveFactor", Role::kEmissive, Channels::kRgb, Zero::kOffByDefault},
    {kSpecGlossExtension, "diffuseTexture", "diffuseFactor", Role::kDiffuse, Channels::kRgb},
    {kSpecGlossExtension, "specularGlossinessTexture", "specularFactor", Role::kSpecular, Channels::kRgb,
     Zero::kOff},
    {kSpecGlossExtension, "specularGlossinessTexture", "glossinessFactor", Role::kGlossiness,
     Channels::kAlpha},
    {kSpecularExtension, "specularTexture", "specularFactor", Role::kOther, Channels::kAlpha, Zero::kOff},
    {kSpecularExtension, "specularColorTexture", "specularColorFactor", Role::kOther, Channels::kRgb,
     Zero::kOff},
    {"KHR_materials_clearcoat", "clearcoatTexture", "clearcoatFactor", Role::kOther, Channels::kRed,
     Zero::kOffByDefault},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", "clearcoatRoughnessFactor", Role::kOther,
     Channels::kGreen, Zero::kLostByDefault},
    {"KHR_materials_sheen", "sheenColorTexture", "sheenColorFactor", Role::kOther, Channels::kRgb,
     Zero::kOffByDefault},
    {"KHR_materials_sheen", "sheenRoughnessTexture", "sheenRoughnessFactor", Role::kOther, Channels::kAlpha,
     Zero::kLostByDefault},
    {"KHR_materials_transmission", "transmissionTexture", "transmissionFactor", Role::kTransmission,
     Channels::kRed, Zero::kOffByDefault},
}};

// An extension whose strength is a factor of 0 adds nothing to the material.
struct Strength {
  std::string_view extension, factor;
  double by_default = 0.0;
};
constexpr std::array<Strength, 9> kStrengths = {{
    {"KHR_materials_anisotropy", "anisotropyStrength"},
    {"KHR_materials_clearcoat", "clearcoatFactor"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor"},
    {"KHR_materials_dispersion", "dispersion"},
    {"KHR_materials_iridescence", "iridescenceFactor"},
    {"KHR_materials_sheen", "sheenColorFactor"},
    {kSpecularExtension, "specularFactor", 1.0},
    {"KHR_materials_transmission", "transmissionFactor"},
    {"KHR_materials_volume", "thicknessFactor"},
}};

// A number, or up to three of a color; empty for none.
std::vector<double> numbers_of(SpanValue value) {
  if (const auto number = value.number()) return {*number};
  std::vector<double> numbers;
  for (const SpanValue entry : value.entries())
    if (numbers.size() < 3) numbers.push_back(entry.number().value_or(1.0));
  return numbers;
}

bool all_are(double wanted, const std::vector<double>& numbers) {
  return std::ranges::all_of(numbers, [&](double number) { return number == wanted; });
}

// Whether nothing that the extension says can be seen, whatever its textures hold.
bool is_off(std::string_view extension, SpanValue value) {
  const auto strength = std::ranges::find(kStrengths, extension, &Strength::extension);
  if (strength == kStrengths.end()) return false;
  const std::vector<double> numbers = numbers_of(value[strength->factor]);
  return numbers.empty() ? strength->by_default == 0.0 : all_are(0.0, numbers);
}

// Whether a material looks the same without the extension.
bool changes_nothing(std::string_view extension, SpanValue extensions) {
  const SpanValue value = extensions[extension];
  if (extension == kIorExtension) return value["ior"].number().value_or(kUsualIor) == kUsualIor;
  if (extension == kSpecularExtension)
    return all_are(1.0, numbers_of(value["specularFactor"])) &&
           all_are(1.0, numbers_of(value["specularColorFactor"])) && !value["specularTexture"] &&
           !value["specularColorTexture"];
  const auto transmits = [&](std::string_view name) {
    return extensions[name].is(SpanKind::kObject) && !is_off(name, extensions[name]);
  };
  // A volume is seen through its surface.
  if ((extension == "KHR_materials_volume" || extension == "KHR_materials_dispersion") &&
      !transmits("KHR_materials_transmission") && !transmits("KHR_materials_diffuse_transmission"))
    return true;
  return is_off(extension, value);
}

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
        container_(read_container(source_, display_path(file))),
        json_(container_.json, display_path(file)),
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
        display_path(file_) + ": material " + (name ? "\"" + plain(*name) + "\"" : std::to_string(index));
    const SpanValue extensions = entry["extensions"];
    const bool is_unlit = extensions[kUnlitExtension].is(SpanKind::kObject);
    // Readers of these read no other extension of the surface.
    const bool is_alone = is_unlit || extensions[kSpecGlossExtension].is(SpanKind::kObject);
    if (extensions.is(SpanKind::kObject))
      for (const SpanValue& extension : extensions.children())
        if (!(is_alone && is_reflecting(extension.key())) && !changes_nothing(extension.key(), extensions))
          material.gltf.extensions.insert(extension.key());
    for (const TexturePlace& place : kPlaces) add_use(entry, place, is_unlit, material);
    material.gltf.metallic_factor = entry[kCoreMember]["metallicFactor"].number().value_or(1.0);
    if (!is_alone) {
      material.gltf.ior = extensions[kIorExtension]["ior"].number();
      material.gltf.specular_factor = extensions[kSpecularExtension]["specularFactor"].number();
    }
    const SpanValue transmission = extensions["KHR_materials_transmission"];
    material.gltf.transmits = transmission["transmissionFactor"].number().value_or(0.0) > 0.0;
    material.gltf.has_volume = extensions["KHR_materials_volume"] || extensions["KHR_materials_dispersion"];
    found_.materials.push_back(std::move(material));
  }

  void add_use(SpanValue entry, const TexturePlace& place, bool is_unlit, CheckedMaterial& material) {
    SpanValue object = entry;
    if (!place.object.empty())
      object = place.object == kCoreMember ? entry[kCoreMember] : entry["extensions"][place.object];
    const std::optional<std::size_t> texture = object[place.texture]["index"].whole();
    const std::optional<std::size_t> map = texture ? map_of(*texture, material) : std::nullopt;
    if (!map) return;
    MaterialUse use{
        place.role, *map, place.channels, std::string(place.texture), {}, std::string(place.factor), false};
    use.factors = numbers_of((place.is_in_texture ? object[place.texture] : object)[place.factor]);
    const SpanValue transform = object[place.texture]["extensions"][kTransformExtension];
    use.tex_coord =
        transform["texCoord"].whole().value_or(object[place.texture]["texCoord"].whole().value_or(0));
    if (transform) use.transform = transform.raw();
    if (use.factors.empty() && place.zero == Zero::kLostByDefault) use.factors = {0.0};
    if (place.object == kSpecularExtension) material.gltf.has_specular_map = true;
    const bool is_off_by_default = use.factors.empty() && place.zero == Zero::kOffByDefault;
    const bool is_off_by_factor = !use.factors.empty() && all_are(0.0, use.factors) &&
                                  (place.zero == Zero::kOff || place.zero == Zero::kOffByDefault);
    // Nobody reads the texture, whatever its own factor is.
    const bool is_unseen = (is_unlit && place.role != Role::kBaseColor) ||
                           (!is_off_by_default && !is_off_by_factor && is_off(place.object, object));
    if (is_unseen) use.factors.clear();
    if (is_unseen) use.factor_name.clear();
    const bool is_unread = is_unseen || is_off_by_default || is_off_by_factor;
    (is_unread ? material.unread : material.uses).push_back(std::move(use));
  }

  // The map of a texture, which is added to the material where it is new; none, with a problem, where no
  // image is known. The images of a texture are those that a conversion reads.
  std::optional<std::size_t> map_of(std::size_t texture, CheckedMaterial& material) {
    std::vector<MaterialMap> images;
    if (texture < textures_.size())
      for (const std::size_t image : images_of_texture(textures_[texture]))
        if (image < images_.size()) images.push_back(map_of_image(image));
    if (images.empty()) {
      found_.problems.push_back(material.name + ": texture " + std::to_string(texture) +
                                " has no image that is known here");
      return std::nullopt;
    }
    MaterialMap map = std::move(images.front());
    map.others.assign(std::make_move_iterator(images.begin() + 1), std::make_move_iterator(images.end()));
    for (std::size_t i = 0; i < material.maps.size(); ++i)
      if (material.maps[i].file == map.file) return i;
    material.maps.push_back(std::move(map));
    return material.maps.size() - 1;
  }

  MaterialMap map_of_image(std::size_t image) {
    const fs::path file = file_of_image(image);
    MaterialMap map;
    map.file = file;
    map.is_embedded = embedded_.contains(image);
    map.shown = map.is_embedded ? image_title(image) : file.string();
    map.name = map.is_embedded ? images_[image]["name"].text().value_or("") : file.filename().string();
    return map;
  }

  std::string image_title(std::size_t image) const {
    return display_path(file_) + ": image " + std::to_string(image);
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
