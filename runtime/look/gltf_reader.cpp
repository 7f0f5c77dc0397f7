#include <array>

#include "assets/gltf/gltf_container.hpp"
#include "assets/gltf/gltf_images.hpp"
#include "assets/gltf/gltf_new_images.hpp"
#include "assets/gltf/gltf_workflow.hpp"
#include "assets/gltf/material_textures.hpp"
#include "assets/maps/map_pixels.hpp"
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

}  // namespace remap
