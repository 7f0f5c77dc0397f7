#include "assets/obj_materials.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <limits>

#include "assets/legacy_maps.hpp"
#include "assets/mtl_asset.hpp"
#include "assets/mtl_material.hpp"
#include "assets/specgloss_material.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "remap/pixels.hpp"

namespace remap {
namespace {

constexpr std::string_view kSpecular = "KHR_materials_specular", kTextureTransform = "KHR_texture_transform";
constexpr std::array<double, 3> kWhite = {1.0, 1.0, 1.0};
constexpr int kClampToEdge = 33071;
constexpr std::size_t kLongestShown = 200;
constexpr std::size_t kNoImage = std::numeric_limits<std::size_t>::max();

double float_value(double value) { return decimal_value(static_cast<float>(value)); }

Json numbers_of(const std::array<double, 3>& values) {
  Json list = Json::list();
  for (const double value : values) list.push_back(float_value(value));
  return list;
}

std::string numbers_text(const std::array<double, 3>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + number_text(float_value(value));
  return text;
}

// The type of an image that glTF holds as it is; empty for others.
const char* core_type_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
  return bytes.starts_with("\xff\xd8\xff") ? "image/jpeg" : "";
}

std::string stem_of(const std::string& path) {
  const std::string name = file_name_of(path);
  const std::size_t dot = name.find_last_of('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

bool lies_alike(const MtlMap& a, const MtlMap& b) {
  return a.scale == b.scale && a.offset == b.offset && a.clamps == b.clamps;
}

// An image of three or four channels: colors of `color`, or white, and alpha of a channel of `opacity`, which
// is as large. Null for none.
ImagePixels with_alpha(const ImagePixels* color, const ImagePixels* opacity, char channel) {
  const ImagePixels& model = color != nullptr ? *color : *opacity;
  ImagePixels result{model.width, model.height, opacity != nullptr ? 4u : 3u, model.type, {}};
  result.bytes.assign(result.width * result.height * result.texel_bytes(), std::byte{255});
  const std::size_t bytes = byte_count(model.type);
  if (color != nullptr)
    for (std::size_t i = 0; i < model.width * model.height; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        std::memcpy(result.bytes.data() + i * result.texel_bytes() + c * bytes,
                    color->bytes.data() + i * color->texel_bytes() + (color->is_grey() ? 0 : c * bytes),
                    bytes);
  if (opacity == nullptr) return result;
  std::vector<float> row(model.width);
  for (std::size_t y = 0; y < model.height; ++y) {
    load_scalar_row(*opacity, channel, y, row.data());
    (void)store_values(result.type, row.data(), row.size(),
                       result.bytes.data() + y * result.width * result.texel_bytes() + 3 * bytes,
                       result.texel_bytes());
  }
  return result;
}

// Opacity is the alpha of a map that has one, as most tools write it, else its luminance.
char opacity_channel(const MtlMap& map, const ImagePixels& pixels) {
  if (map.channel != '\0') return map.channel;
  return pixels.has_alpha() ? 'm' : 'l';
}

bool is_there(const AssetResources& resources, const std::string& path) {
  try {
    (void)resources.open(path);
    return true;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return false;
  }
}

}  // namespace

// An MTL file and its images.
struct ObjMaterials::Library {
  std::string text;
  MtlDocument document;
  MtlImages images;

  Library(std::string content, const std::string& path, const AssetResources& resources)
      : text(std::move(content)), document(text, plain(path)), images(&resources, folder_of(path)) {}

  static std::string folder_of(const std::string& path) {
    const std::size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
  }
};

// What a conversion of maps became, without its pixels; kNoImage where it is a factor.
struct ObjMaterials::ConvertedImages {
  LegacyMapResult result;
  bool has_own_base = false;
  std::size_t base = kNoImage, metal_rough = kNoImage, specular = kNoImage;
};

// A material on its way into the file.
struct ObjMaterials::Planned {
  Planned(Library& own_library, const MtlBlock& own_block, AssetMaterial& own_report)
      : library(own_library), block(own_block), report(own_report) {}

  Library& library;
  const MtlBlock& block;
  AssetMaterial& report;
  MtlSurface surface;
  MtlCover cover;
  std::array<double, 3> base = {1.0, 1.0, 1.0};
  double alpha = 1.0, metallic = 0.0, roughness = 1.0;
  // The map of base color: a file as it is, or pixels. `base_map` says where it lies on the surface.
  const MtlMap* base_map = nullptr;
  bool keeps_file = false;
  std::shared_ptr<const ImagePixels> base_pixels;
  std::size_t base_image = kNoImage;    // that is in the file already
  std::size_t* shared_image = nullptr;  // where others find it
  Json core = Json::object(), material = Json::object();
  bool blends = false;

  // A map that is missing or cannot be read leaves the rest of the material.
  bool attempt(const std::function<void()>& step) {
    try {
      step();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      report.state = MaterialState::kFailed;
      report.failure += (report.failure.empty() ? "" : "; ") + std::string(error.what());
      return false;
    }
    return true;
  }
};

ObjMaterials::ObjMaterials(const AssetOptions& options, const AssetResources& resources, ImagePlace place,
                           GltfBuffer& buffer, AssetConversion& conversion)
    : options_(options), resources_(resources), place_(place), buffer_(buffer), conversion_(conversion) {}

ObjMaterials::~ObjMaterials() = default;

void ObjMaterials::read_libraries(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    // A line is one name with spaces, or several names. A name that leads elsewhere may lie here.
    if (read_library(line)) continue;
    std::vector<std::string> missing;
    std::size_t found = 0;
    for (const std::string& name : parts_between(line, ' ')) {
      if (name.empty()) continue;
      if (read_library(name) || read_library(file_name_of(name)))
        ++found;
      else
        missing.push_back(name);
    }
    if (found == 0 && read_library(file_name_of(line))) continue;
    if (found > 0 && missing.empty()) continue;
    conversion_.warnings.push_back("mtllib " +
                                   plain(missing.size() == 1 ? missing.front() : line, kLongestShown) +
                                   ": is not there; its materials count as white");
  }
  reads_tr_ = is_tr_opacity();
}

bool ObjMaterials::read_library(const std::string& name) {
  const std::optional<std::string> path = path_within("", name);
  if (!path || !is_there(resources_, *path)) return false;
  if (!library_paths_.insert(*path).second) return true;
  auto library =
      std::make_unique<Library>(mtl_text(*resources_.open(*path), plain(*path)), *path, resources_);
  const MtlDocument& document = library->document;
  for (std::size_t i = 0; i < document.materials().size(); ++i)
    blocks_.try_emplace(document.materials()[i].name, library.get(), i);
  for (std::size_t i = 0; i < document.statements().size(); ++i)
    if (is_mtl_map(document.word(document.statements()[i])))
      if (const auto taken = library->images.place_of(read_mtl_map(document, i).file)) names_.take(*taken);
  libraries_.push_back(std::move(library));
  return true;
}

// MeshLab writes Tr 1 for what is opaque, where the specification has 1 - d.
bool ObjMaterials::is_tr_opacity() const {
  bool has_material = false;
  for (const std::unique_ptr<Library>& library : libraries_)
    for (const MtlBlock& block : library->document.materials()) {
      std::vector<std::string> ignored;
      try {
        const MtlCover cover = read_mtl_cover(library->document, block, ignored);
        if (cover.opacity || cover.transparency.value_or(0.0) < 1.0) return true;
      } catch (const Error&) {
        return true;
      }
      has_material = true;
    }
  if (has_material)
    conversion_.warnings.push_back(
        "Tr is 1 in every material and d in none, as MeshLab writes it: the materials are opaque");
  return !has_material;
}

GltfMaterialLists ObjMaterials::converted(const std::vector<ObjMaterialName>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    AssetMaterial& report = conversion_.materials.emplace_back();
    report.index = i;
    report.name = names[i].name;
    const std::size_t before = texture_uses_;
    lists_.materials.push_back(material_of(names[i], report));
    lists_.has_texture.push_back(texture_uses_ > before);
  }
  return std::move(lists_);
}

Json ObjMaterials::material_of(const ObjMaterialName& name, AssetMaterial& report) {
  const auto found = name.is_given ? blocks_.find(name.name) : blocks_.end();
  if (found == blocks_.end()) {
    Json material = Json::object();
    if (!name.name.empty()) material["name"] = utf8_name(name.name);
    material["pbrMetallicRoughness"] = Json{{"metallicFactor", 0}};
    if (name.is_given) report.warnings.push_back("is in no MTL file that is there, and counts as white");
    return material;
  }
  Library& library = *found->second.first;
  return converted_block(library, library.document.materials()[found->second.second], report);
}

Json ObjMaterials::converted_block(Library& library, const MtlBlock& block, AssetMaterial& report) {
  Planned planned(library, block, report);
  report.state = MaterialState::kConverted;
  if (!block.name.empty()) planned.material["name"] = utf8_name(block.name);
  planned.attempt([&] { planned.surface = read_mtl_surface(library.document, block, report.warnings); });
  planned.attempt([&] { planned.cover = read_mtl_cover(library.document, block, report.warnings); });
  set_reflection(planned);
  planned.attempt([&] { set_opacity(planned); });
  Json& core = planned.core;
  Json color = numbers_of(planned.base);
  color.push_back(float_value(planned.alpha));
  Json factors = Json::object();
  factors["baseColorFactor"] = std::move(color);
  const bool has_base = planned.attempt([&] {
    if (planned.base_map == nullptr) return;
    const std::size_t image = base_image_of(planned);
    factors["baseColorTexture"] = texture_info(image, *planned.base_map);
  });
  if (!has_base) planned.base_map = nullptr;
  factors["metallicFactor"] = float_value(planned.metallic);
  factors["roughnessFactor"] = float_value(planned.roughness);
  factors.update(core);
  planned.material["pbrMetallicRoughness"] = factors;
  planned.attempt([&] { set_normals(planned); });
  planned.attempt([&] { set_emission(planned); });
  if (planned.blends) planned.material["alphaMode"] = "BLEND";
  if (planned.cover.has_height)
    report.warnings.push_back("loses its bump map: it is a map of heights, and glTF has maps of normals");
  report.becomes = "base color " + std::string(planned.base_map != nullptr ? "map times " : "") +
                   numbers_text(planned.base);
  if (planned.alpha != 1.0 || planned.blends) report.becomes += ", alpha " + number_text(planned.alpha);
  const bool has_map = core.contains("metallicRoughnessTexture");
  report.becomes += ", metallic " + number_text(float_value(planned.metallic)) + ", roughness " +
                    number_text(float_value(planned.roughness)) + (has_map ? ", both times map" : "");
  if (!has_map && planned.base_map == nullptr)
    report.factors = {{"base_color", {planned.base.begin(), planned.base.end()}},
                      {"metallic", {planned.metallic}},
                      {"roughness", {planned.roughness}}};
  return std::move(planned.material);
}

std::size_t ObjMaterials::base_image_of(Planned& planned) {
  if (planned.keeps_file) return add_file_image(planned.library, *planned.base_map, planned.report.warnings);
  if (planned.base_image == kNoImage)
    planned.base_image =
        add_new_image(planned.library, *planned.base_pixels, *planned.base_map, "_baseColor");
  if (planned.shared_image != nullptr) *planned.shared_image = planned.base_image;
  return planned.base_image;
}

// A map that fails leaves the factors, and that of diffuse.
void ObjMaterials::set_reflection(Planned& planned) {
  const bool is_done = planned.attempt([&] {
    if (is_metal_rough(planned.library.document, planned.block)) return set_metal_rough(planned);
    const MtlReflection reflection = reflection_of(planned.surface, planned.report.warnings);
    if (options_.profile == MaterialProfile::kExtensions)
      set_dielectric(planned, reflection);
    else
      set_core(planned, reflection);
  });
  if (is_done) return;
  planned.base = planned.surface.diffuse.value_or(kWhite);
  planned.metallic = 0.0;
  keep_diffuse_map(planned);
}

void ObjMaterials::keep_diffuse_map(Planned& planned) {
  if (!planned.surface.diffuse_map) return;
  planned.base_map = &*planned.surface.diffuse_map;
  planned.keeps_file = true;
}

// Later tools' lines say what glTF does. A map of them stands in the place of the number.
void ObjMaterials::set_metal_rough(Planned& planned) {
  const MtlSurface& surface = planned.surface;
  planned.base = surface.diffuse.value_or(kWhite);
  keep_diffuse_map(planned);
  planned.metallic = surface.metallic.value_or(0.0);
  planned.roughness = surface.roughness.value_or(1.0);
  if (!surface.roughness && !surface.roughness_map)
    planned.report.warnings.push_back("has metallic (Pm) but no roughness (Pr), which then counts as 1");
  const MtlMap* model = nullptr;
  if (const auto pixels = packed_metal_rough(planned, &model)) {
    if (surface.roughness_map) planned.roughness = 1.0;
    if (surface.metallic_map) planned.metallic = 1.0;
    planned.core["metallicRoughnessTexture"] =
        texture_info(add_new_image(planned.library, *pixels, *model, "_metallicRoughness"), *model);
  }
}

std::shared_ptr<const ImagePixels> ObjMaterials::packed_metal_rough(Planned& planned, const MtlMap** model) {
  std::shared_ptr<ImagePixels> packed;
  const auto add = [&](const std::optional<MtlMap>& map, std::size_t channel) {
    if (!map) return;
    const std::shared_ptr<const ImagePixels> pixels =
        planned.library.images.load(*map, planned.report.warnings);
    if (packed && (packed->width != pixels->width || packed->height != pixels->height))
      throw input_error("map_Pr and map_Pm differ in size (make them equal)");
    if (*model != nullptr && !lies_alike(**model, *map))
      throw input_error("map_Pr and map_Pm lie on the surface in different places (-s, -o, -clamp)");
    if (!packed) {
      packed = std::make_shared<ImagePixels>(ImagePixels{pixels->width, pixels->height, 3, pixels->type, {}});
      packed->bytes.assign(packed->width * packed->height * packed->texel_bytes(), std::byte{255});
      *model = &*map;
    }
    std::vector<float> row(pixels->width);
    const std::size_t texel = packed->texel_bytes();
    for (std::size_t y = 0; y < pixels->height; ++y) {
      load_scalar_row(*pixels, map->channel, y, row.data());
      (void)store_values(
          packed->type, row.data(), row.size(),
          packed->bytes.data() + y * packed->width * texel + channel * byte_count(packed->type), texel);
    }
  };
  add(planned.surface.roughness_map, 1);
  add(planned.surface.metallic_map, 2);
  return packed;
}

void ObjMaterials::set_core(Planned& planned, const MtlReflection& reflection) {
  const MtlSurface& surface = planned.surface;
  const bool has_maps = surface.diffuse_map || surface.specular_map || surface.exponent_map;
  planned.base = reflection.factors.diffuse;
  if (has_maps && reflection.has_highlight) return set_converted_maps(planned, reflection, false);
  const MetalRoughFactors core = reflection.has_highlight ? core_of_legacy(reflection.factors)
                                                          : core_of_diffuse(reflection.factors.diffuse);
  for (std::size_t c = 0; c < 3; ++c) planned.base[c] = static_cast<double>(core.base_color[c]);
  planned.metallic = static_cast<double>(core.metallic);
  planned.roughness = static_cast<double>(core.roughness);
  keep_diffuse_map(planned);
}

void ObjMaterials::set_dielectric(Planned& planned, const MtlReflection& reflection) {
  const MtlSurface& surface = planned.surface;
  planned.base = reflection.factors.diffuse;
  Json specular = Json::object();
  if (!reflection.has_highlight) {
    specular["specularFactor"] = 0;
    keep_diffuse_map(planned);
  } else {
    // A map of diffuse alone is divided by 1 - F as a factor is.
    LegacyMaterial white = reflection.factors;
    const LegacyDielectric result = dielectric_of_legacy(white);
    const bool is_factor = std::ranges::none_of(result.base_color, [](double value) { return value >= 1.0; });
    const bool has_maps = surface.specular_map || surface.exponent_map || (surface.diffuse_map && !is_factor);
    if (has_maps) return set_converted_maps(planned, reflection, true);
    planned.base = result.base_color;
    planned.roughness = result.roughness;
    keep_diffuse_map(planned);
    specular["specularFactor"] = float_value(result.specular);
    std::array<double, 3> color{};
    for (std::size_t c = 0; c < 3; ++c) color[c] = kDielectricScale * result.specular_color[c];
    specular["specularColorFactor"] = numbers_of(color);
  }
  lists_.extensions.emplace(kSpecular);
  planned.material["extensions"] = Json::object();
  planned.material["extensions"][std::string(kSpecular)] = specular;
}

void ObjMaterials::set_converted_maps(Planned& planned, const MtlReflection& reflection, bool as_dielectric) {
  const MtlSurface& surface = planned.surface;
  const MtlMap& data_map = surface.specular_map   ? *surface.specular_map
                           : surface.exponent_map ? *surface.exponent_map
                                                  : *surface.diffuse_map;
  if (surface.exponent_map) planned.report.warnings.push_back(exponent_warning(surface));
  const std::string opacity = planned.cover.opacity_map ? planned.cover.opacity_map->file : "";
  const std::string key = planned.library.images.folder() + '\0' + opacity + '\0' +
                          (is_transparent(planned) ? "1" : "0") + key_of(surface, reflection.factors);
  std::shared_ptr<ConvertedImages>& known = converted_[key];
  std::shared_ptr<const ImagePixels> base_pixels;
  if (!known || (known->has_own_base && known->base == kNoImage)) {
    auto images = std::make_shared<ConvertedImages>();
    const SurfaceMaps maps = load_maps(surface, planned.library.images, options_, planned.report.warnings);
    images->result = converted_maps(maps.with(reflection.factors, surface, as_dielectric));
    LegacyMapResult& result = images->result;
    images->has_own_base = result.base_color.has_value();
    if (result.base_color) base_pixels = std::make_shared<const ImagePixels>(*std::move(result.base_color));
    if (result.metal_rough)
      images->metal_rough =
          add_new_image(planned.library, *result.metal_rough, data_map, "_metallicRoughness");
    if (result.specular)
      images->specular = add_new_image(planned.library, *result.specular, data_map, "_specular");
    result.base_color.reset();
    result.metal_rough.reset();
    result.specular.reset();
    known = std::move(images);
  }
  const LegacyMapResult& result = known->result;
  planned.base = result.base;
  planned.metallic = as_dielectric ? 0.0 : result.metallic;
  planned.roughness = result.roughness;
  if (result.keeps_diffuse) keep_diffuse_map(planned);
  if (known->has_own_base) {
    planned.base_map = surface.diffuse_map ? &*surface.diffuse_map : &data_map;
    planned.base_pixels = base_pixels;
    planned.base_image = known->base;
    planned.shared_image = &known->base;
  }
  if (known->metal_rough != kNoImage)
    planned.core["metallicRoughnessTexture"] = texture_info(known->metal_rough, data_map);
  if (!as_dielectric) return;
  Json specular = Json::object();
  std::array<double, 3> color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = kDielectricScale * result.specular_color[c];
  specular["specularFactor"] = float_value(result.specular_factor);
  specular["specularColorFactor"] = numbers_of(color);
  if (known->specular != kNoImage) {
    specular["specularTexture"] = texture_info(known->specular, data_map);
    specular["specularColorTexture"] = texture_info(known->specular, data_map);
  }
  lists_.extensions.emplace(kSpecular);
  planned.material["extensions"] = Json::object();
  planned.material["extensions"][std::string(kSpecular)] = specular;
}

double ObjMaterials::alpha_of(const MtlCover& cover) const {
  if (cover.opacity) return *cover.opacity;
  return reads_tr_ ? 1.0 - cover.transparency.value_or(0.0) : 1.0;
}

bool ObjMaterials::is_transparent(const Planned& planned) const {
  return planned.cover.opacity_map || alpha_of(planned.cover) < 1.0;
}

// Opacity is the alpha of base color. Without it, the alpha of an image says nothing.
void ObjMaterials::set_opacity(Planned& planned) {
  const std::optional<MtlMap>& opacity_map = planned.cover.opacity_map;
  planned.alpha = alpha_of(planned.cover);
  planned.blends = is_transparent(planned);
  const bool has_base_map = planned.base_map != nullptr;
  if (!planned.blends || planned.base_image != kNoImage || (!has_base_map && !opacity_map)) return;
  MtlImages& images = planned.library.images;
  std::vector<std::string>& warnings = planned.report.warnings;
  if (planned.keeps_file) {
    // Other materials may have the same two files.
    const std::string key = images.folder() + '\0' + planned.base_map->file + '\0' +
                            (opacity_map ? opacity_map->file + '\0' + opacity_map->options : "");
    planned.shared_image = &composed_.try_emplace(key, kNoImage).first->second;
    planned.base_image = *planned.shared_image;
    planned.keeps_file = planned.base_image == kNoImage;
    if (!planned.keeps_file) return;
  }
  std::shared_ptr<const ImagePixels> color = planned.base_pixels, opacity;
  if (planned.keeps_file) color = images.load(*planned.base_map, warnings);
  char channel = 'l';
  if (opacity_map) {
    opacity = images.load(*opacity_map, warnings);
    channel = opacity_channel(*opacity_map, *opacity);
    if (has_base_map && !lies_alike(*planned.base_map, *opacity_map))
      throw input_error("map_Kd and map_d lie on the surface in different places (-s, -o, -clamp)");
  } else if (!planned.keeps_file || !color->has_alpha()) {
    return;
  }
  // Many materials name one file for both.
  if (planned.keeps_file && opacity == color && channel == 'm' && opacity->has_alpha()) return;
  if (color && opacity && (color->width != opacity->width || color->height != opacity->height)) {
    if (!options_.enlarges)
      throw input_error(plain(opacity_map->file, kLongestShown) +
                        ": its size differs from that of map_Kd (--resample enlarges the smaller one)");
    const std::size_t width = std::max(color->width, opacity->width),
                      height = std::max(color->height, opacity->height);
    color = std::make_shared<const ImagePixels>(resources_.enlarged(*color, width, height));
    opacity = std::make_shared<const ImagePixels>(resources_.enlarged(*opacity, width, height));
  }
  planned.base_pixels = std::make_shared<const ImagePixels>(with_alpha(color.get(), opacity.get(), channel));
  planned.keeps_file = false;
  if (!has_base_map) planned.base_map = &*opacity_map;
}

void ObjMaterials::set_emission(Planned& planned) {
  const MtlCover& cover = planned.cover;
  std::array<double, 3> factor = cover.emissive;
  const bool is_dark = std::ranges::all_of(factor, [](double value) { return value <= 0.0; });
  if (cover.emissive_map) {
    if (cover.has_emissive && is_dark)
      planned.report.warnings.push_back("Ke is 0 beside map_Ke, and counts as 1");
    if (is_dark) factor = kWhite;
    const std::size_t image = add_file_image(planned.library, *cover.emissive_map, planned.report.warnings);
    planned.material["emissiveTexture"] = texture_info(image, *cover.emissive_map);
  }
  if (cover.emissive_map || !is_dark) planned.material["emissiveFactor"] = numbers_of(factor);
}

void ObjMaterials::set_normals(Planned& planned) {
  const std::optional<MtlMap>& map = planned.cover.normal_map;
  if (!map) return;
  Json info = texture_info(add_file_image(planned.library, *map, planned.report.warnings), *map);
  if (map->strength != 1.0) info["scale"] = float_value(map->strength);
  planned.material["normalTexture"] = std::move(info);
}

std::size_t ObjMaterials::add_file_image(Library& library, const MtlMap& map,
                                         std::vector<std::string>& warnings) {
  if (!map.unusual.empty()) (void)library.images.load(map, warnings);  // throws
  const std::optional<std::string> path = library.images.find(map.file, warnings);
  if (!path)
    throw input_error(plain(map.file, kLongestShown) + ": is not there (put it beside the MTL file)");
  if (const auto known = file_images_.find(*path); known != file_images_.end()) return known->second;
  const std::string bytes = library.images.bytes_of(*path);
  const char* const type = core_type_of(bytes);
  std::size_t index = 0;
  if (*type == '\0') {
    index = add_new_image(library, *library.images.load(*path), map, "");
  } else if (place_ == ImagePlace::kBuffer) {
    index = add_image_bytes(bytes, type, utf8_name(stem_of(*path)));
  } else {
    lists_.images.push_back(Json{{"uri", uri_of_path(*path)}});
    conversion_.resources.push_back({"", *path, UriKind::kFile});
    index = lists_.images.size() - 1;
  }
  return file_images_[*path] = index;
}

std::size_t ObjMaterials::add_new_image(Library& library, const ImagePixels& pixels, const MtlMap& model,
                                        std::string_view suffix) {
  const std::string name = names_.free_name(library.images.place_of(model.file).value_or("material"), suffix);
  const std::string png = resources_.codec().encode_png(pixels);
  if (place_ == ImagePlace::kBuffer) return add_image_bytes(png, "image/png", utf8_name(stem_of(name)));
  conversion_.files.push_back({name, png});
  lists_.images.push_back(Json{{"uri", uri_of_path(name)}});
  return lists_.images.size() - 1;
}

std::size_t ObjMaterials::add_image_bytes(std::string_view bytes, const char* type, const std::string& name) {
  lists_.images.push_back(Json{{"bufferView", buffer_.add_view(bytes)}, {"mimeType", type}, {"name", name}});
  return lists_.images.size() - 1;
}

// MTL counts v from the bottom: v' = s v + o becomes 1 - v' = s (1 - v) + 1 - s - o.
Json ObjMaterials::texture_info(std::size_t image, const MtlMap& map) {
  ++texture_uses_;
  const auto [known, is_new] = textures_.try_emplace({image, map.clamps}, lists_.textures.size());
  if (is_new) {
    if (lists_.samplers.empty()) lists_.samplers.push_back(Json::object());
    Json texture{{"source", image}, {"sampler", 0}};
    if (map.clamps) {
      if (lists_.samplers.size() < 2)
        lists_.samplers.push_back(Json{{"wrapS", kClampToEdge}, {"wrapT", kClampToEdge}});
      texture["sampler"] = 1;
    }
    lists_.textures.push_back(std::move(texture));
  }
  Json info{{"index", known->second}};
  if (map.scale == std::array{1.0, 1.0} && map.offset == std::array{0.0, 0.0}) return info;
  Json transform = Json::object();
  transform["offset"] =
      Json::list({float_value(map.offset[0]), float_value(1.0 - map.scale[1] - map.offset[1])});
  transform["scale"] = Json::list({float_value(map.scale[0]), float_value(map.scale[1])});
  info["extensions"] = Json::object();
  info["extensions"][std::string(kTextureTransform)] = std::move(transform);
  lists_.extensions.emplace(kTextureTransform);
  return info;
}

std::string uri_of_path(const std::string& path) {
  constexpr std::string_view kPlain = "-._~/";
  std::string uri;
  for (const char c : path) {
    const bool is_plain_byte = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                               kPlain.find(c) != std::string_view::npos;
    uri += is_plain_byte ? std::string(1, c) : percent_code(c);
  }
  return uri;
}

std::string utf8_name(const std::string& text) {
  if (is_utf8(text)) return text;
  std::string result;
  for (const char c : text) result += utf8_of(static_cast<std::uint8_t>(c));
  return result;
}

}  // namespace remap
