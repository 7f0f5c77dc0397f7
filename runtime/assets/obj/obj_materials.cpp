#include "assets/obj/obj_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/gltf_inputs.hpp"
#include "assets/maps/legacy_maps.hpp"
#include "assets/maps/map_pixels.hpp"
#include "assets/mtl/mtl_material.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "remap/pixels.hpp"

namespace remap {
namespace {

constexpr std::array<double, 3> kWhite = {1.0, 1.0, 1.0};
constexpr std::size_t kLongestShown = 200;
constexpr std::size_t kNoImage = std::numeric_limits<std::size_t>::max();

Json numbers_of(const std::array<double, 3>& values) {
  Json list = Json::list();
  for (const double value : values) list.push_back(float_value(value));
  return list;
}

std::string numbers_text(const std::array<double, 3>& values) {
  return joined(values, " ", [](double value) { return number_text(float_value(value)); });
}

Json specular_of(double specular, const std::array<double, 3>& color) {
  std::array<double, 3> scaled{};
  for (std::size_t c = 0; c < 3; ++c) scaled[c] = kDielectricScale * color[c];
  return Json{{"specularFactor", float_value(specular)}, {"specularColorFactor", numbers_of(scaled)}};
}

// Returns the channel of opacity: alpha if the map has alpha, because most tools write it there, otherwise
// luminance.
char opacity_channel(const MtlMap& map, const ImagePixels& pixels) {
  if (map.channel != '\0') return map.channel;
  return pixels.has_alpha() ? 'm' : 'l';
}

}  // namespace

// A ConvertedImages holds the images from a conversion of maps. kNoImage means that the result is a factor.
struct ObjMaterials::ConvertedImages {
  LegacyMapResult result;
  bool has_own_base = false;
  std::size_t base = kNoImage, metal_rough = kNoImage, specular = kNoImage;
};

// A MaterialDraft is a material that is being prepared for the file.
struct ObjMaterials::MaterialDraft {
  MaterialDraft(MtlLibrary& own_library, const MtlBlock& own_block, AssetMaterial& own_report)
      : library(own_library), block(own_block), report(own_report) {}

  MtlLibrary& library;
  const MtlBlock& block;
  AssetMaterial& report;
  MtlSurface surface;
  MtlCover cover;
  std::array<double, 3> base = {1.0, 1.0, 1.0};
  double alpha = 1.0, metallic = 0.0, roughness = 1.0;
  // This is the map of base color: a file that stays unchanged, or pixels. `base_map` contains the options
  // that place it on the surface.
  const MtlMap* base_map = nullptr;
  bool keeps_file = false;
  std::shared_ptr<const ImagePixels> base_pixels;
  std::size_t base_image = kNoImage;    // index of an image in the file
  std::size_t* shared_image = nullptr;  // place where other materials find the index of this image
  Json core = Json::object(), material = Json::object();
  bool blends = false;

  // Runs a step that needs one map. If the map is missing or cannot be read, only this step is lost.
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

ObjMaterials::ObjMaterials(const AssetOptions& options, const AssetResources& resources,
                           const MtlLibraries& libraries, GltfTextures& textures, AssetConversion& conversion)
    : options_(options),
      resources_(resources),
      libraries_(libraries),
      textures_(textures),
      conversion_(conversion),
      reads_tr_(!libraries.has_tr_for_opaque()) {
  if (!reads_tr_)
    conversion.warnings.push_back(
        "every material has Tr 1 and no d, as MeshLab writes opaque materials: texremap treats them as "
        "opaque");
}

ObjMaterials::~ObjMaterials() = default;

std::vector<SceneMaterial> ObjMaterials::converted(const std::vector<std::optional<std::string>>& names) {
  std::vector<SceneMaterial> materials;
  for (std::size_t i = 0; i < names.size(); ++i) {
    AssetMaterial& report = conversion_.materials.emplace_back();
    report.index = i;
    report.name = names[i].value_or("");
    const std::size_t before = textures_.info_count();
    SceneMaterial& material = materials.emplace_back();
    material.json = material_of(names[i], report);
    material.has_texture = textures_.info_count() > before;
  }
  return materials;
}

Json ObjMaterials::material_of(const std::optional<std::string>& name, AssetMaterial& report) {
  const auto found = name ? libraries_.find(*name) : std::nullopt;
  if (found) return converted_block(*found->library, *found->block, report);
  Json material = Json::object();
  if (name && !name->empty()) material["name"] = utf8_name(*name);
  material["pbrMetallicRoughness"] = Json{{"metallicFactor", 0}};
  if (name) report.warnings.push_back("is in no MTL file that was found, and becomes white");
  return material;
}

Json ObjMaterials::converted_block(MtlLibrary& library, const MtlBlock& block, AssetMaterial& report) {
  MaterialDraft draft(library, block, report);
  report.state = MaterialState::kConverted;
  if (!block.name.empty()) draft.material["name"] = utf8_name(block.name);
  draft.attempt(
      [&] { read_mtl_surface(library.document, block, library.maker, draft.surface, report.warnings); });
  draft.attempt(
      [&] { draft.cover = read_mtl_cover(library.document, block, library.maker, report.warnings); });
  set_reflection(draft);
  // Do not share a base image whose opacity map failed.
  if (!draft.attempt([&] { set_opacity(draft); })) draft.shared_image = nullptr;
  Json color = numbers_of(draft.base);
  color.push_back(float_value(draft.alpha));
  Json factors = Json::object();
  factors["baseColorFactor"] = std::move(color);
  const bool has_base = draft.attempt([&] {
    if (draft.base_map == nullptr) return;
    const std::size_t image = base_image_of(draft);
    factors["baseColorTexture"] = textures_.info(image, *draft.base_map);
  });
  if (!has_base) draft.base_map = nullptr;
  factors["metallicFactor"] = float_value(draft.metallic);
  factors["roughnessFactor"] = float_value(draft.roughness);
  factors.update(draft.core);
  draft.material["pbrMetallicRoughness"] = factors;
  draft.attempt([&] { set_normals(draft); });
  draft.attempt([&] { set_emission(draft); });
  if (draft.blends) draft.material["alphaMode"] = "BLEND";
  if (draft.cover.has_displacement)
    report.warnings.push_back("loses its displacement map (disp), which glTF does not support");
  describe(draft);
  return std::move(draft.material);
}

void ObjMaterials::describe(const MaterialDraft& draft) {
  AssetMaterial& report = draft.report;
  report.becomes =
      "base color " + std::string(draft.base_map != nullptr ? "map times " : "") + numbers_text(draft.base);
  if (draft.alpha != 1.0 || draft.blends) report.becomes += ", alpha " + number_text(draft.alpha);
  const bool has_map = draft.core.contains("metallicRoughnessTexture");
  report.becomes += ", metallic " + number_text(float_value(draft.metallic)) + ", roughness " +
                    number_text(float_value(draft.roughness)) + (has_map ? ", both times map" : "");
  if (!has_map && draft.base_map == nullptr)
    report.factors = {{"base_color", {draft.base.begin(), draft.base.end()}},
                      {"metallic", {draft.metallic}},
                      {"roughness", {draft.roughness}}};
}

std::size_t ObjMaterials::base_image_of(MaterialDraft& draft) {
  if (draft.keeps_file)
    return textures_.add_file(draft.library.images, *draft.base_map, draft.report.warnings);
  if (draft.base_image == kNoImage)
    draft.base_image =
        textures_.add_pixels(draft.library.images, *draft.base_pixels, *draft.base_map, "_baseColor");
  if (draft.shared_image != nullptr) *draft.shared_image = draft.base_image;
  return draft.base_image;
}

// If a map fails, the material keeps its factors and its diffuse map.
void ObjMaterials::set_reflection(MaterialDraft& draft) {
  const bool is_done = draft.attempt([&] {
    if (draft.surface.is_metal_rough) return set_metal_rough(draft);
    if (is_glass(draft)) return set_glass(draft);
    const LegacyMaterial factors = reflection_of(draft.surface, draft.report.warnings);
    if (options_.writes_extensions())
      set_dielectric(draft, factors);
    else
      set_core(draft, factors);
  });
  if (is_done) return;
  draft.base = draft.surface.diffuse.value_or(kWhite);
  draft.metallic = 0.0;
  keep_diffuse_map(draft);
}

void ObjMaterials::keep_diffuse_map(MaterialDraft& draft) {
  if (!draft.surface.diffuse_map) return;
  draft.base_map = &*draft.surface.diffuse_map;
  draft.keeps_file = true;
}

// Uses Pr, Pm and their maps, which mean the same as in glTF. A map replaces the number.
void ObjMaterials::set_metal_rough(MaterialDraft& draft) {
  const MtlSurface& surface = draft.surface;
  const MetalRoughFactors numbers = metal_rough_of(surface, !options_.writes_extensions());
  draft.base = numbers.base_color;
  keep_diffuse_map(draft);
  draft.metallic = numbers.metallic;
  draft.roughness = numbers.roughness;
  set_specular_level(draft);
  if (!surface.roughness && !surface.roughness_map)
    draft.report.warnings.push_back("has metallic (Pm) but no roughness (Pr): texremap uses roughness 1");
  const MtlMap* model = nullptr;
  if (const auto pixels = packed_metal_rough(draft, &model))
    draft.core["metallicRoughnessTexture"] = textures_.info(
        textures_.add_pixels(draft.library.images, *pixels, *model, "_metallicRoughness"), *model);
}

// Sets the level. Level 1 is an F0 of 0.04, the default of glTF. Metals have no specular level.
void ObjMaterials::set_specular_level(MaterialDraft& draft) {
  constexpr double kSeen = 0.25;  // smaller changes of the level are invisible: F0 0.03 to 0.05 look alike
  const double level = draft.surface.specular_level.value_or(1.0);
  if (std::fabs(level - 1.0) < kSeen || draft.metallic == 1.0) return;
  if (!options_.writes_extensions()) {
    if (level > 0.0)
      draft.report.warnings.push_back("loses its specular level Ks " + number_text(0.5 * level) +
                                      " (--extensions write keeps it)");
    return;
  }
  set_extension(draft, kSpecularExtension,
                level <= 1.0 ? Json{{"specularFactor", float_value(level)}}
                             : Json{{"specularColorFactor", numbers_of({level, level, level})}});
}

// Detects glass. illum 4, 6, 7 and 9 refract, but Maya writes illum 4 with index 1 for opaque materials.
bool ObjMaterials::is_glass(MaterialDraft& draft) const {
  const MtlCover& cover = draft.cover;
  if (!cover.refracts || is_transparent(draft) || cover.refraction.value_or(2.0) <= 1.0) return false;
  if (cover.refraction && options_.writes_extensions()) return true;
  draft.report.warnings.push_back(
      cover.refraction
          ? "is glass according to illum and Ni " + number_text(*cover.refraction) +
                ", but becomes opaque (--extensions write keeps the glass)"
          : "refracts by illum, but has no index Ni, so it becomes opaque (add a line Ni 1.5 for glass)");
  return false;
}

// Sets the index of refraction, which determines how much is reflected, and Tf, the color of transmitted
// light.
void ObjMaterials::set_glass(MaterialDraft& draft) {
  const LegacyMaterial factors = reflection_of(draft.surface, draft.report.warnings);
  draft.base = draft.cover.filter;
  draft.roughness = factors.has_highlight() ? ggx_roughness(factors) : 0.0;
  set_extension(draft, kTransmissionExtension, Json{{"transmissionFactor", 1}});
  set_extension(draft, kIorExtension, Json{{"ior", float_value(*draft.cover.refraction)}});
}

std::shared_ptr<const ImagePixels> ObjMaterials::packed_metal_rough(MaterialDraft& draft,
                                                                    const MtlMap** model) {
  std::shared_ptr<ImagePixels> packed;
  const auto add = [&](const std::optional<MtlMap>& map, std::size_t channel) {
    if (!map) return;
    const std::shared_ptr<const ImagePixels> pixels = draft.library.images.load(*map, draft.report.warnings);
    if (packed && (packed->width != pixels->width || packed->height != pixels->height))
      throw input_error("map_Pr and map_Pm differ in size (scale one of the images)");
    if (*model != nullptr && !(*model)->lies_like(*map))
      throw input_error(
          "map_Pr and map_Pm have different options -s, -o or -clamp (give both maps the same options)");
    if (!packed) {
      packed = std::make_shared<ImagePixels>(blank_like(*pixels, 3));
      *model = &*map;
    }
    set_channel(*packed, channel, *pixels, map->channel);
  };
  add(draft.surface.roughness_map, 1);
  add(draft.surface.metallic_map, 2);
  return packed;
}

void ObjMaterials::set_core(MaterialDraft& draft, const LegacyMaterial& factors) {
  const MtlSurface& surface = draft.surface;
  const bool has_maps = surface.diffuse_map || surface.specular_map || surface.exponent_map;
  draft.base = factors.diffuse;
  if (has_maps && factors.has_highlight()) return set_converted_maps(draft, factors, false);
  const MetalRoughFactors core = core_of_legacy(factors);
  draft.base = core.base_color;
  draft.metallic = core.metallic;
  draft.roughness = core.roughness;
  keep_diffuse_map(draft);
}

void ObjMaterials::set_dielectric(MaterialDraft& draft, const LegacyMaterial& factors) {
  const MtlSurface& surface = draft.surface;
  draft.base = factors.diffuse;
  if (!factors.has_highlight()) {
    keep_diffuse_map(draft);
    return set_extension(draft, kSpecularExtension, Json{{"specularFactor", 0}});
  }
  // If diffuse is a map, the map is divided by 1 - F like a factor.
  const LegacyDielectric result = dielectric_of_legacy(factors);
  const bool is_factor = std::ranges::none_of(result.base_color, [](double value) { return value >= 1.0; });
  if (surface.specular_map || surface.exponent_map || (surface.diffuse_map && !is_factor))
    return set_converted_maps(draft, factors, true);
  draft.base = result.base_color;
  draft.roughness = result.roughness;
  keep_diffuse_map(draft);
  set_extension(draft, kSpecularExtension, specular_of(result.specular, result.specular_color));
}

void ObjMaterials::set_extension(MaterialDraft& draft, std::string_view name, Json value) {
  extensions_.emplace(name);
  if (!draft.material.contains("extensions")) draft.material["extensions"] = Json::object();
  draft.material["extensions"][std::string(name)] = std::move(value);
}

void ObjMaterials::set_converted_maps(MaterialDraft& draft, const LegacyMaterial& factors,
                                      bool as_dielectric) {
  const MtlSurface& surface = draft.surface;
  const MtlMap& data_map = surface.specular_map   ? *surface.specular_map
                           : surface.exponent_map ? *surface.exponent_map
                                                  : *surface.diffuse_map;
  if (surface.exponent_map) draft.report.warnings.push_back(exponent_warning(surface));
  ConvertedImages& images = converted_images(draft, factors, as_dielectric, data_map);
  const LegacyMapResult& result = images.result;
  draft.base = result.factors.base_color;
  draft.metallic = as_dielectric ? 0.0 : result.factors.metallic;
  draft.roughness = result.factors.roughness;
  if (result.keeps_diffuse) keep_diffuse_map(draft);
  if (images.has_own_base) {
    draft.base_map = surface.diffuse_map ? &*surface.diffuse_map : &data_map;
    draft.base_image = images.base;
    draft.shared_image = &images.base;
  }
  if (images.metal_rough != kNoImage)
    draft.core["metallicRoughnessTexture"] = textures_.info(images.metal_rough, data_map);
  if (!as_dielectric) return;
  Json specular = specular_of(result.specular_factor, result.specular_color);
  if (images.specular != kNoImage) {
    specular["specularTexture"] = textures_.info(images.specular, data_map);
    specular["specularColorTexture"] = textures_.info(images.specular, data_map);
  }
  set_extension(draft, kSpecularExtension, std::move(specular));
}

// Returns converted images, which materials with the same maps, factors and opacity share. If the base color
// is not stored yet, sets `draft.base_pixels`, so that opacity can be added before it is stored.
ObjMaterials::ConvertedImages& ObjMaterials::converted_images(MaterialDraft& draft,
                                                              const LegacyMaterial& factors,
                                                              bool as_dielectric, const MtlMap& data_map) {
  MtlImages& images = draft.library.images;
  const std::optional<MtlMap>& opacity_map = draft.cover.opacity_map;
  const std::string opacity = opacity_map ? opacity_map->file + '\0' + opacity_map->options : "";
  const std::string key = images.folder() + '\0' + opacity + '\0' + (is_transparent(draft) ? "1" : "0") +
                          key_of(draft.surface, factors);
  std::shared_ptr<ConvertedImages>& known = converted_[key];
  if (known && (!known->has_own_base || known->base != kNoImage)) return *known;
  LegacyMaps maps = load_maps(draft.surface, factors, images, options_, draft.report.warnings);
  maps.as_dielectric = as_dielectric;
  auto made = std::make_shared<ConvertedImages>();
  made->result = converted_maps(maps);
  LegacyMapResult& result = made->result;
  made->has_own_base = result.base_color.has_value();
  if (result.base_color)
    draft.base_pixels = std::make_shared<const ImagePixels>(*std::move(result.base_color));
  if (result.metal_rough)
    made->metal_rough = textures_.add_pixels(images, *result.metal_rough, data_map, "_metallicRoughness");
  if (result.specular) made->specular = textures_.add_pixels(images, *result.specular, data_map, "_specular");
  result.base_color.reset();
  result.metal_rough.reset();
  result.specular.reset();
  known = std::move(made);
  return *known;
}

double ObjMaterials::alpha_of(const MtlCover& cover) const {
  if (cover.opacity) return *cover.opacity;
  return reads_tr_ ? 1.0 - cover.transparency.value_or(0.0) : 1.0;
}

bool ObjMaterials::is_transparent(const MaterialDraft& draft) const {
  return draft.cover.opacity_map || alpha_of(draft.cover) < 1.0;
}

// Opacity becomes the alpha of base color. Without opacity, the alpha of an image is ignored.
void ObjMaterials::set_opacity(MaterialDraft& draft) {
  const std::optional<MtlMap>& opacity_map = draft.cover.opacity_map;
  draft.alpha = alpha_of(draft.cover);
  draft.blends = is_transparent(draft);
  const bool has_map = draft.base_map != nullptr || opacity_map;
  if (!draft.blends || draft.base_image != kNoImage || !has_map) return;
  if (draft.base_pixels == nullptr) {
    // Other materials may combine the same two files, so keep the result.
    const std::string key =
        draft.library.images.folder() + '\0' +
        (draft.base_map != nullptr ? draft.base_map->file + '\0' + draft.base_map->options : "") + '\0' +
        (opacity_map ? opacity_map->file + '\0' + opacity_map->options : "");
    draft.shared_image = &composed_.try_emplace(key, kNoImage).first->second;
    draft.base_image = *draft.shared_image;
  }
  const bool is_new = draft.base_image != kNoImage || add_opacity(draft);
  if (!is_new) return;
  draft.keeps_file = false;
  if (draft.base_map == nullptr) draft.base_map = &*opacity_map;
}

// Returns true if the pixels differ from the file.
bool ObjMaterials::add_opacity(MaterialDraft& draft) {
  const std::optional<MtlMap>& opacity_map = draft.cover.opacity_map;
  MtlImages& images = draft.library.images;
  std::vector<std::string>& warnings = draft.report.warnings;
  std::shared_ptr<const ImagePixels> color = draft.base_pixels, opacity;
  if (draft.keeps_file) color = images.load(*draft.base_map, warnings);
  char channel = 'l';
  if (opacity_map) {
    opacity = images.load(*opacity_map, warnings);
    channel = opacity_channel(*opacity_map, *opacity);
    if (draft.base_map != nullptr && !draft.base_map->lies_like(*opacity_map))
      throw input_error(
          "map_Kd and map_d have different options -s, -o or -clamp (give both maps the same options)");
  } else if (!draft.keeps_file || !color->has_alpha()) {
    return !draft.keeps_file;
  }
  // Many materials use one file for both color and opacity. Such a file stays unchanged.
  if (draft.keeps_file && opacity == color && channel == 'm' && opacity->has_alpha()) return false;
  if (color && opacity && (color->width != opacity->width || color->height != opacity->height)) {
    if (!options_.resamples)
      throw input_error(plain(opacity_map->file, kLongestShown) +
                        ": its size differs from map_Kd (--resample enlarges the smaller one)");
    const std::size_t width = std::max(color->width, opacity->width),
                      height = std::max(color->height, opacity->height);
    color = std::make_shared<const ImagePixels>(resources_.enlarged(*color, width, height));
    opacity = std::make_shared<const ImagePixels>(resources_.enlarged(*opacity, width, height));
  }
  draft.base_pixels = std::make_shared<const ImagePixels>(with_alpha(color.get(), opacity.get(), channel));
  return true;
}

void ObjMaterials::set_emission(MaterialDraft& draft) {
  const MtlCover& cover = draft.cover;
  std::array<double, 3> factor = cover.emissive;
  const bool is_dark = std::ranges::all_of(factor, [](double value) { return value <= 0.0; });
  if (cover.emissive_map) {
    if (cover.has_emissive && is_dark)
      draft.report.warnings.push_back("Ke is 0, which would make map_Ke black: texremap uses Ke 1");
    if (is_dark) factor = kWhite;
    const std::size_t image =
        textures_.add_file(draft.library.images, *cover.emissive_map, draft.report.warnings);
    draft.material["emissiveTexture"] = textures_.info(image, *cover.emissive_map);
  }
  if (cover.emissive_map || !is_dark) draft.material["emissiveFactor"] = numbers_of(factor);
}

// Most exporters write normals as map_Bump, because MTL has no statement for them that all programs know.
void ObjMaterials::set_normals(MaterialDraft& draft) {
  const std::optional<MtlMap>&bump = draft.cover.bump_map,
        &map = draft.cover.normal_map ? draft.cover.normal_map : bump;
  if (!map) return;
  if (!draft.cover.normal_map && !holds_normals(*draft.library.images.load(*bump, draft.report.warnings))) {
    draft.report.warnings.push_back(
        "loses its bump map, because it holds heights and glTF only supports normal maps");
    return;
  }
  Json info = textures_.info(textures_.add_file(draft.library.images, *map, draft.report.warnings), *map);
  if (map->strength != 1.0) info["scale"] = float_value(map->strength);
  draft.material["normalTexture"] = std::move(info);
}

}  // namespace remap
