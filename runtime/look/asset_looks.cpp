#include <array>
#include <list>

#include "assets/gltf/gltf_container.hpp"
#include "assets/gltf/gltf_images.hpp"
#include "assets/gltf/gltf_new_images.hpp"
#include "assets/gltf/gltf_workflow.hpp"
#include "assets/gltf/material_textures.hpp"
#include "assets/maps/legacy_maps.hpp"
#include "assets/maps/map_pixels.hpp"
#include "assets/mtl/mtl_libraries.hpp"
#include "assets/mtl/mtl_material.hpp"
#include "assets/obj/obj_mesh.hpp"
#include "core/errors.hpp"
#include "core/json_spans.hpp"
#include "look/material_looks.hpp"

namespace remap {
namespace {

GltfWorkflow workflow_of(SpanValue material) {
  const SpanValue extensions = material["extensions"];
  if (extensions["KHR_materials_pbrSpecularGlossiness"]) return GltfWorkflow::kSpecGloss;
  const bool has_f0 = extensions["KHR_materials_specular"] || extensions["KHR_materials_ior"];
  return has_f0 ? GltfWorkflow::kDielectric : GltfWorkflow::kMetalRough;
}

// A GltfReader reads materials as maps of the plain specular workflow.
class GltfReader final : public AssetReader {
 public:
  explicit GltfReader(const AssetFile& file)
      : container_(read_container(file.bytes, file.context)),
        json_(container_.json, file.context),
        bytes_(json_, container_, file.bytes,
               [&resources = file.resources](const std::string& path) { return resources.open(path); }),
        images_(json_, bytes_, file.resources),
        added_(json_, container_, file.resources, file.context),
        textures_(options_, file.resources, images_, added_) {}

  ScaledMaps maps(const AssetMaterial& material, int side) override {
    const SpanValue text = text_of(material);
    return maps(text, workflow_of(text), side);
  }

  TexturedBall ball(const AssetMaterial& material, const ShownModel& ggx, ScaledMaps maps) const override {
    return ball(ggx, workflow_of(text_of(material)), std::move(maps));
  }

  std::optional<TexturedBall> without_extensions(const AssetMaterial& material, const ShownModel& ggx,
                                                 int side) override {
    const SpanValue text = text_of(material);
    constexpr auto kCore = GltfWorkflow::kMetalRough;
    return workflow_of(text) == kCore ? std::nullopt
                                      : std::optional(ball(ggx, kCore, maps(text, kCore, side)));
  }

  Image normals(const AssetMaterial& of, int side) override {
    constexpr std::array kInputs = {GltfInput::kNormal};
    std::vector<std::string> ignored;
    const GltfMaterial material = read_inputs(text_of(of), kInputs, ignored);
    const SpanValue info = material[GltfInput::kNormal].texture;
    if (!info) return {};
    const UsedTexture texture = textures_.load(info, GltfInput::kNormal);
    const ImagePixels& pixels = texture.pixels();
    if (pixels.is_grey()) return {};
    SourceParameter stored = color_source(&pixels, {1.0, 1.0, 1.0}, "normal");
    stored.transfer = Transfer::kLinear;
    const ScaledMaps scaled =  // the stored values count as a color
        scaled_maps({{Parameter::kDiffuse, stored}}, pixels.width, pixels.height,
                    RoughnessEncoding::kRoughness, side);
    return normals_of(scaled.rows.at(Parameter::kDiffuse), scaled.width, material.number(GltfInput::kNormal),
                      NormalGreen::kUp);
  }

 private:
  SpanValue text_of(const AssetMaterial& material) const {
    return json_.root()["materials"].children().at(material.index);
  }

  // Returns the maps of a material in the parameters of the workflow.
  ScaledMaps maps(SpanValue text, GltfWorkflow workflow, int side) {
    std::vector<std::string> ignored;
    GltfMaterial material = read_material(text, workflow, ignored);
    const std::optional<UsedTextures> used =
        used_textures(&textures_, material, inputs_of(workflow), {"the picture", ""}, ignored);
    if (!used) {
      ScaledMaps maps;
      for (const auto& [parameter, values] : values_of(workflow, material))
        for (const float value : values) maps.rows[parameter].push_back({value});
      return maps;
    }
    const GltfMaps read(workflow, material, *used);
    const ImagePixels& model = *read.sources.color_model;
    const MapConversion& conversion = read.sources.conversion;
    return scaled_maps(conversion.sources, model.width, model.height, *conversion.source_convention, side);
  }

  TexturedBall ball(const ShownModel& model, GltfWorkflow workflow, ScaledMaps maps) const {
    const auto plain = converter_of(workflow, "specular", options_);
    return model.ball(std::nullopt, converted(*plain, std::move(maps)));
  }

  // Maps of different sizes and transforms are shown as well, although a conversion may refuse them.
  static AssetOptions tolerant() {
    AssetOptions options;
    options.resamples = true;
    return options;
  }

  const AssetOptions options_ = tolerant();
  GltfContainer container_;
  SpannedJson json_;
  GltfBytes bytes_;
  GltfImages images_;
  GltfNewImages added_;
  MaterialTextures textures_;
};

}  // namespace

std::unique_ptr<AssetReader> gltf_reader(const AssetFile& file) { return std::make_unique<GltfReader>(file); }

namespace {

constexpr const char* kLegacyModel = "legacy/blinn-phong";

class MtlReader final : public AssetReader {
 public:
  MtlReader(const AssetFile& file, std::optional<MtlMaker> maker, bool is_obj)
      : libraries_(file.resources, maker) {
    std::vector<std::string> ignored;
    if (is_obj)
      libraries_.read(obj_libraries(file.bytes, file.context), file.context, ignored);
    else
      own_ = std::make_unique<MtlLibrary>(mtl_text(file.bytes, file.context), "", file.resources, maker);
  }

  ScaledMaps maps(const AssetMaterial& material, int side) override {
    const MtlLibraries::Entry entry = entry_of(material);
    std::vector<std::string> ignored;
    MtlSurface surface;
    read_mtl_surface(entry.library->document, *entry.block, entry.library->maker, surface, ignored);
    return surface.is_metal_rough ? metal_rough_maps_of(surface, entry.library->images, side)
                                  : legacy_maps_of(surface, entry.library->images, side);
  }

  TexturedBall ball(const AssetMaterial&, const ShownModel& ggx, ScaledMaps maps) const override {
    if (!maps.rows.contains(Parameter::kMetallic)) return ball_of(kLegacyModel, std::move(maps));
    const auto plain = converter_of(GltfWorkflow::kMetalRough, "specular", AssetOptions());
    return ggx.ball(std::nullopt, converted(*plain, std::move(maps)));
  }

 private:
  MtlLibraries::Entry entry_of(const AssetMaterial& material) {
    if (own_ != nullptr) return {own_.get(), &own_->document.materials().at(material.index)};
    const auto entry = libraries_.find(material.name);
    if (!entry)
      throw input_error(material.title() + ": is in no MTL file that was found, so it is not shown");
    return *entry;
  }

  // Textures have the size of `model`. It is null if all sources are constants.
  static ScaledMaps scaled_to(int side, const std::map<Parameter, SourceParameter>& sources,
                              const ImagePixels* model, RoughnessEncoding encoding) {
    return model == nullptr ? scaled_maps(sources, 1, 1, encoding, side)
                            : scaled_maps(sources, model->width, model->height, encoding, side);
  }

  static ScaledMaps legacy_maps_of(const MtlSurface& surface, MtlImages& images, int side) {
    std::vector<std::string> ignored;
    AssetOptions tolerant;
    tolerant.resamples = true;
    const LegacyMaps loaded = load_maps(surface, reflection_of(surface, ignored), images, tolerant, ignored);
    ImagePixels exponents;
    const auto sources = sources_of(loaded, exponents);
    const ImagePixels* model = nullptr;
    for (const auto& pixels : {loaded.diffuse, loaded.specular, loaded.exponent})
      if (pixels != nullptr) model = pixels.get();
    return scaled_to(side, sources, model, RoughnessEncoding::kExponent);
  }

  static ScaledMaps metal_rough_maps_of(const MtlSurface& surface, MtlImages& images, int side) {
    std::vector<std::string> ignored;
    const MetalRoughFactors factors = metal_rough_of(surface, true);
    std::vector<std::shared_ptr<const ImagePixels>> loaded;
    const auto load = [&](const std::optional<MtlMap>& map) -> const ImagePixels* {
      if (!map) return nullptr;
      loaded.push_back(images.load(*map, ignored));
      if (loaded.front()->width != loaded.back()->width || loaded.front()->height != loaded.back()->height)
        throw input_error("its maps differ in size, so it is not shown");
      return loaded.back().get();
    };
    std::list<ImagePixels> scalars;
    const auto load_scalar = [&](const std::optional<MtlMap>& map) -> const ImagePixels* {
      const ImagePixels* pixels = load(map);
      return pixels == nullptr ? nullptr : &scalars.emplace_back(scalar_map(*pixels, map->channel));
    };
    std::map<Parameter, SourceParameter> sources;
    sources[Parameter::kBaseColor] =
        color_source(load(surface.diffuse_map), factors.base_color, "base color");
    sources[Parameter::kMetallic] =
        value_source(load_scalar(surface.metallic_map), 0, factors.metallic, "metallic");
    sources[Parameter::kRoughness] =
        value_source(load_scalar(surface.roughness_map), 0, factors.roughness, "roughness");
    return scaled_to(side, sources, loaded.empty() ? nullptr : loaded.front().get(),
                     RoughnessEncoding::kRoughness);
  }

  MtlLibraries libraries_;           // of an OBJ file
  std::unique_ptr<MtlLibrary> own_;  // of an MTL file
};

}  // namespace

std::unique_ptr<AssetReader> mtl_reader(const AssetFile& file, std::optional<MtlMaker> maker, bool is_obj) {
  return std::make_unique<MtlReader>(file, maker, is_obj);
}

}  // namespace remap
