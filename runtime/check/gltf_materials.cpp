// This file reads materials of glTF 2.0 files (.gltf, .glb), with Khronos extensions for reflection.
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
#include "assets/gltf/gltf_container.hpp"
#include "assets/gltf/gltf_images.hpp"
#include "assets/gltf/gltf_inputs.hpp"
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
constexpr std::uintmax_t kLargestAsset = std::uintmax_t{4} << 30;  // the limit of the glb format

struct InputRole {
  GltfInput input;
  Role role;
  bool is_off_at_zero = false;  // true if a factor of 0 turns the texture off
};

constexpr std::array<InputRole, 16> kRoles = {{
    {GltfInput::kBaseColor, Role::kBaseColor},
    {GltfInput::kRoughness, Role::kRoughness},
    {GltfInput::kMetallic, Role::kMetallic, true},
    {GltfInput::kNormal, Role::kNormal, true},
    {GltfInput::kOcclusion, Role::kOcclusion, true},
    {GltfInput::kEmissive, Role::kEmissive, true},
    {GltfInput::kDiffuse, Role::kDiffuse},
    {GltfInput::kSpecGlossSpecular, Role::kSpecular, true},
    {GltfInput::kGlossiness, Role::kGlossiness},
    {GltfInput::kSpecular, Role::kOther, true},
    {GltfInput::kSpecularColor, Role::kOther, true},
    {GltfInput::kClearcoat, Role::kOther, true},
    {GltfInput::kClearcoatRoughness, Role::kOther},
    {GltfInput::kSheenColor, Role::kOther, true},
    {GltfInput::kSheenRoughness, Role::kOther},
    {GltfInput::kTransmission, Role::kTransmission, true},
}};

Channels channels_of(GltfInput input) {
  constexpr std::array kSingle = {Channels::kRed, Channels::kGreen, Channels::kBlue, Channels::kAlpha};
  const GltfInputInfo& info = info_of(input);
  return info.count > 1 || input == GltfInput::kNormal ? Channels::kRgb : kSingle[info.channel];
}

// A Strength is a factor of an extension. If it is 0, the extension adds nothing to the material.
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

// Returns a number, or up to three numbers of a color. Returns nothing if there are none.
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

// Returns true if the extension has no visible effect, whatever its textures hold.
bool is_off(std::string_view extension, SpanValue value) {
  const auto strength = std::ranges::find(kStrengths, extension, &Strength::extension);
  if (strength == kStrengths.end()) return false;
  const std::vector<double> numbers = numbers_of(value[strength->factor]);
  return numbers.empty() ? strength->by_default == 0.0 : all_are(0.0, numbers);
}

// Returns true if a material looks the same without the extension.
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
  // A volume is visible only through a surface that transmits light.
  if ((extension == "KHR_materials_volume" || extension == "KHR_materials_dispersion") &&
      !transmits("KHR_materials_transmission") && !transmits("KHR_materials_diffuse_transmission"))
    return true;
  return is_off(extension, value);
}

class GltfMaterials {
 public:
  GltfMaterials(const fs::path& file, FoundMaterials& found)
      : file_(file),
        found_(found),
        source_(read_file(file, kLargestAsset)),
        container_(read_container(source_, display_path(file))),
        json_(container_.json, display_path(file)),
        bytes_(json_, container_, source_,
               [folder = file.parent_path()](const std::string& path) {
                 return std::make_unique<MemorySource>(read_file(folder / path, kLargestAsset));
               }),
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
    material.path = file_;
    const std::optional<std::string> name = entry["name"].text();
    material.name =
        display_path(file_) + ": material " + (name ? "\"" + plain(*name) + "\"" : std::to_string(index));
    GltfMaterial read;
    try {
      std::vector<std::string> clamped;
      read = read_inputs(entry, all_inputs(), clamped);
    } catch (const Error& error) {
      found_.problems.push_back(material.name + ": " + error.what());
      return;
    }
    const SpanValue extensions = entry["extensions"];
    const bool is_unlit = extensions[kUnlitExtension].is(SpanKind::kObject);
    // Programs that know one of these two extensions ignore every other extension of the surface.
    const bool is_alone = is_unlit || extensions[kSpecGlossExtension].is(SpanKind::kObject);
    if (extensions.is(SpanKind::kObject))
      for (const SpanValue& extension : extensions.children())
        if (!(is_alone && is_reflecting(extension.key())) && !changes_nothing(extension.key(), extensions))
          material.gltf.extensions.insert(extension.key());
    for (const InputRole& role : kRoles) add_use(read, role, is_unlit, material);
    material.gltf.metallic_factor = read.number(GltfInput::kMetallic);
    if (!is_alone) {
      material.gltf.ior = extensions[kIorExtension]["ior"].number();
      // The factor is kept as written, because values above 1 are reported.
      material.gltf.specular_factor = extensions[kSpecularExtension]["specularFactor"].number();
    }
    material.gltf.transmits = read.number(GltfInput::kTransmission) > 0.0;
    material.gltf.has_volume = extensions["KHR_materials_volume"] || extensions["KHR_materials_dispersion"];
    found_.materials.push_back(std::move(material));
  }

  void add_use(const GltfMaterial& read, const InputRole& role, bool is_unlit, CheckedMaterial& material) {
    const GltfInputInfo& info = info_of(role.input);
    const GltfValue& value = read[role.input];
    const std::optional<std::size_t> texture = value.texture["index"].whole();
    const std::optional<std::size_t> map = texture ? map_of(*texture, material) : std::nullopt;
    if (!map) return;
    MaterialUse use{
        role.role, *map, channels_of(role.input), std::string(info.texture), {}, std::string(info.factor),
        false};
    for (std::size_t c = 0; value.is_stated && c < std::min<std::size_t>(info.count, 3); ++c)
      use.factors.push_back(value.factor[c].value);
    const SpanValue transform = value.texture["extensions"][kTransformExtension];
    use.tex_coord = transform["texCoord"].whole().value_or(value.texture["texCoord"].whole().value_or(0));
    if (transform) use.transform = transform.raw();
    const bool is_zero_by_default = !value.is_stated && info.usual == 0.0;
    if (is_zero_by_default && !role.is_off_at_zero) use.factors = {0.0};
    if (info.object == kSpecularExtension) material.gltf.has_specular_map = true;
    const bool is_off_by_factor =
        role.is_off_at_zero && (is_zero_by_default || (!use.factors.empty() && all_are(0.0, use.factors)));
    // If an extension is off, its textures are not visible, whatever their own factors are.
    const bool is_unseen = (is_unlit && role.role != Role::kBaseColor) ||
                           (!is_off_by_factor && is_off(info.object, read.text["extensions"][info.object]));
    if (is_unseen) use.factors.clear();
    if (is_unseen) use.factor_name.clear();
    const bool is_unread = is_unseen || is_off_by_factor;
    (is_unread ? material.unread : material.uses).push_back(std::move(use));
  }

  // Returns the map of a texture, and adds it to the material if it is new. If no image is known, returns
  // nothing and reports a problem. It chooses the same images as a conversion.
  std::optional<std::size_t> map_of(std::size_t texture, CheckedMaterial& material) {
    std::vector<MaterialMap> images;
    if (texture < textures_.size())
      for (const std::size_t image : images_of_texture(textures_[texture]))
        if (image < images_.size()) images.push_back(map_of_image(image));
    if (images.empty()) {
      found_.problems.push_back(material.name + ": texture " + std::to_string(texture) +
                                " has no image in a known format (export it with PNG or JPEG images)");
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
  MemorySource source_;
  GltfContainer container_;
  SpannedJson json_;
  GltfBytes bytes_;
  std::vector<SpanValue> textures_, images_;
  std::map<std::size_t, fs::path> embedded_;  // temporary files of images that are embedded in the asset
};

}  // namespace

void add_gltf(const fs::path& file, FoundMaterials& found) { GltfMaterials(file, found).add_all(); }

}  // namespace remap
