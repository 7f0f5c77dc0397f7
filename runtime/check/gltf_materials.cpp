// Materials of glTF 2.0 files (.gltf, .glb), with the extensions of Khronos that say what a surface reflects.
#include <algorithm>
#include <array>
#include <string_view>

#include "assets/asset_uri.hpp"
#include "assets/gltf_container.hpp"
#include "check/material.hpp"
#include "core/base64.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
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

constexpr std::string_view kCore = "pbrMetallicRoughness", kSpecGloss = "KHR_materials_pbrSpecularGlossiness";

constexpr std::array<TexturePlace, 16> kPlaces = {{
    {kCore, "baseColorTexture", "baseColorFactor", Role::kBaseColor, Channels::kRgb},
    {kCore, "metallicRoughnessTexture", "roughnessFactor", Role::kRoughness, Channels::kGreen},
    {kCore, "metallicRoughnessTexture", "metallicFactor", Role::kMetallic, Channels::kBlue},
    {"", "normalTexture", "", Role::kNormal, Channels::kRgb},
    {"", "occlusionTexture", "", Role::kOcclusion, Channels::kRed},
    {"", "emissiveTexture", "emissiveFactor", Role::kEmissive, Channels::kRgb, true},
    {kSpecGloss, "diffuseTexture", "diffuseFactor", Role::kDiffuse, Channels::kRgb},
    {kSpecGloss, "specularGlossinessTexture", "specularFactor", Role::kSpecular, Channels::kRgb},
    {kSpecGloss, "specularGlossinessTexture", "glossinessFactor", Role::kGlossiness, Channels::kAlpha},
    {"KHR_materials_specular", "specularTexture", "specularFactor", Role::kOther, Channels::kAlpha},
    {"KHR_materials_specular", "specularColorTexture", "specularColorFactor", Role::kOther, Channels::kRgb},
    {"KHR_materials_clearcoat", "clearcoatTexture", "clearcoatFactor", Role::kOther, Channels::kRed, true},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", "clearcoatRoughnessFactor", Role::kOther,
     Channels::kGreen, true},
    {"KHR_materials_sheen", "sheenColorTexture", "sheenColorFactor", Role::kOther, Channels::kRgb, true},
    {"KHR_materials_sheen", "sheenRoughnessTexture", "sheenRoughnessFactor", Role::kOther, Channels::kAlpha,
     true},
    {"KHR_materials_transmission", "transmissionTexture", "transmissionFactor", Role::kTransmission,
     Channels::kRed, true},
}};

// The bytes of a data URI in base64, whose text begins at `begin`.
std::string bytes_of_uri(std::string_view uri, std::size_t begin, const std::string& place) {
  auto bytes = from_base64<std::string>(uri.substr(begin));
  if (!bytes) throw input_error(place + ": is not base64");
  return *std::move(bytes);
}

// The text and the binary chunk of a file.
struct GltfFile {
  std::string json;
  std::string binary;
};

GltfFile read_gltf(const fs::path& file) {
  const std::string bytes = read_file(file, kLargestAsset);
  GltfContainer container = read_container(MemorySource(bytes), shown(file));
  GltfFile parts{std::move(container.json), {}};
  if (const GlbChunk* const chunk = container.binary_chunk())
    parts.binary = bytes.substr(chunk->content_begin(), chunk->content_size());
  return parts;
}

class GltfMaterials {
 public:
  GltfMaterials(const fs::path& file, FoundMaterials& found)
      : file_(file), found_(found), parts_(read_gltf(file)), json_(parse_json(parts_.json, shown(file))) {}

  void add_all() {
    const Json* materials = json_.find("materials");
    if (materials == nullptr || materials->entries() == nullptr) return;
    std::size_t index = 0;
    for (const Json& entry : *materials->entries()) add(entry, index++);
  }

 private:
  void add(const Json& entry, std::size_t index) {
    CheckedMaterial material;
    material.kind = MaterialKind::kGltf;
    material.place = file_;
    const Json* name = entry.find("name");
    material.name = shown(file_) + ": material " +
                    (name != nullptr && name->text() != nullptr ? "\"" + plain(*name->text()) + "\""
                                                                : std::to_string(index));
    const Json* extensions = entry.find("extensions");
    if (extensions != nullptr && extensions->fields() != nullptr)
      for (const auto& [extension, content] : *extensions->fields())
        material.gltf.extensions.insert(extension);
    for (const TexturePlace& place : kPlaces) add_use(entry, place, material);
    const auto number = [&](const char* extension, const char* field) -> std::optional<double> {
      const Json* own = extensions != nullptr ? extensions->find(extension) : nullptr;
      const Json* value = own != nullptr ? own->find(field) : nullptr;
      return value != nullptr ? value->number() : std::nullopt;
    };
    material.gltf.ior = number("KHR_materials_ior", "ior");
    material.gltf.specular_factor = number("KHR_materials_specular", "specularFactor");
    material.gltf.transmits = number("KHR_materials_transmission", "transmissionFactor").value_or(0.0) > 0.0;
    found_.materials.push_back(std::move(material));
  }

  void add_use(const Json& entry, const TexturePlace& place, CheckedMaterial& material) {
    const Json* object = &entry;
    if (place.object == kCore) object = entry.find(kCore);
    if (!place.object.empty() && place.object != kCore) {
      const Json* extensions = entry.find("extensions");
      object = extensions != nullptr ? extensions->find(place.object) : nullptr;
    }
    const Json* texture = object != nullptr ? object->find(place.texture) : nullptr;
    const Json* index = texture != nullptr ? texture->find("index") : nullptr;
    if (index == nullptr || !index->whole()) return;
    const std::optional<std::size_t> map = map_of(*index->whole(), material);
    if (!map) return;
    MaterialUse use{
        place.role, *map, place.channels, std::string(place.texture), {}, std::string(place.factor), false};
    const Json* factor = place.factor.empty() ? nullptr : object->find(place.factor);
    if (factor == nullptr && place.zero_is_default) use.factors = {0.0};
    if (factor != nullptr && factor->number()) use.factors = {*factor->number()};
    if (factor != nullptr && factor->entries() != nullptr)
      for (std::size_t c = 0; c < std::min<std::size_t>(3, factor->size()); ++c)
        use.factors.push_back((*factor->entries())[c].number().value_or(1.0));
    if (place.object == "KHR_materials_specular") material.gltf.has_specular_map = true;
    material.uses.push_back(std::move(use));
  }

  // The map of a texture, which is added to the material where it is new; none where nothing says where it
  // is.
  std::optional<std::size_t> map_of(std::int64_t texture, CheckedMaterial& material) {
    const Json* entry = entry_of("textures", texture);
    const Json* source = entry != nullptr ? entry->find("source") : nullptr;
    if (source == nullptr || !source->whole()) return std::nullopt;
    const std::int64_t image = *source->whole();
    const std::optional<fs::path> file = file_of_image(image);
    if (!file) return std::nullopt;
    for (std::size_t i = 0; i < material.maps.size(); ++i)
      if (material.maps[i].file == *file) return i;
    const bool is_embedded = embedded_.contains(image);
    const Json* name = entry_of("images", image)->find("name");
    material.maps.push_back({*file,
                             is_embedded ? shown(file_) + ": image " + std::to_string(image) : shown(*file),
                             is_embedded ? (name != nullptr && name->text() != nullptr ? *name->text() : "")
                                         : file->filename().string(),
                             nullptr});
    return material.maps.size() - 1;
  }

  std::optional<fs::path> file_of_image(std::int64_t image) {
    const Json* entry = entry_of("images", image);
    if (entry == nullptr) return std::nullopt;
    const Json* uri = entry->find("uri");
    if (uri != nullptr && uri->text() != nullptr && !uri->text()->starts_with("data:"))
      return file_.parent_path() / percent_decoded(*uri->text());
    if (const auto known = embedded_.find(image); known != embedded_.end()) return known->second;
    const std::string place = shown(file_) + ": image " + std::to_string(image);
    std::string bytes;
    if (uri != nullptr && uri->text() != nullptr) {
      const std::size_t comma = uri->text()->find(";base64,");
      if (comma == std::string::npos) return std::nullopt;
      bytes = bytes_of_uri(*uri->text(), comma + 8, place);
    } else {
      bytes = bytes_of_view(*entry, place);
    }
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

  // The bytes of a buffer: of the binary chunk, a data URI or a file.
  const std::string& bytes_of_buffer(std::int64_t buffer, const std::string& place) {
    const Json* entry = entry_of("buffers", buffer);
    const Json* uri = entry != nullptr ? entry->find("uri") : nullptr;
    if (uri == nullptr || uri->text() == nullptr) return parts_.binary;
    const auto [known, is_new] = buffers_.try_emplace(buffer);
    if (!is_new) return known->second;
    const std::string& text = *uri->text();
    const std::size_t comma = text.find(";base64,");
    if (!text.starts_with("data:"))
      known->second = read_file(file_.parent_path() / percent_decoded(text), kLargestAsset);
    else if (comma != std::string::npos)
      known->second = bytes_of_uri(text, comma + 8, place);
    return known->second;
  }

  std::string bytes_of_view(const Json& entry, const std::string& place) {
    const Json* index = entry.find("bufferView");
    const Json* view =
        index != nullptr && index->whole() ? entry_of("bufferViews", *index->whole()) : nullptr;
    const auto whole = [&](const char* field, std::int64_t otherwise) {
      const Json* value = view != nullptr ? view->find(field) : nullptr;
      return value != nullptr ? value->whole().value_or(-1) : otherwise;
    };
    const std::string& bytes = bytes_of_buffer(whole("buffer", 0), place);
    const std::int64_t offset = whole("byteOffset", 0), length = whole("byteLength", -1);
    const auto size = static_cast<std::int64_t>(bytes.size());
    if (offset < 0 || length < 0 || offset > size || length > size - offset)
      throw input_error(place + ": its bytes are not in the buffer that it names");
    return bytes.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
  }

  const Json* entry_of(const char* list, std::int64_t index) const {
    const Json* all = json_.find(list);
    const Json::List* entries = all != nullptr ? all->entries() : nullptr;
    if (entries == nullptr || index < 0 || index >= static_cast<std::int64_t>(entries->size()))
      return nullptr;
    return &(*entries)[static_cast<std::size_t>(index)];
  }

  const fs::path& file_;
  FoundMaterials& found_;
  GltfFile parts_;
  Json json_;
  std::map<std::int64_t, std::string> buffers_;  // that are read
  std::map<std::int64_t, fs::path> embedded_;    // files of images that are part of the asset
};

}  // namespace

void add_gltf(const fs::path& file, FoundMaterials& found) { GltfMaterials(file, found).add_all(); }

}  // namespace remap
