// KHR_materials_specular and KHR_materials_ior go into core: their material is converted to spec-gloss and
// from there by the projection, in one converter.
#include <array>
#include <memory>
#include <optional>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/core_material.hpp"
#include "assets/gltf/core_textures.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "assets/maps/specgloss_factors.hpp"
#include "core/errors.hpp"

namespace remap {
namespace {

class SpecularFold final : public GltfDirection {
 public:
  explicit SpecularFold(const DirectionParts& parts)
      : converter_(make_core_converter("gltf", true, parts.options.prior, parts.options.instructions)) {
    if (parts.textures != nullptr) textures_.emplace(*parts.textures);
  }

  bool takes(SpanValue material) const override {
    const SpanValue extensions = material["extensions"];
    return (extensions[kSpecularExtension] || extensions[kIorExtension]) &&
           !extensions[kSpecGlossExtension] && !extensions[kUnlitExtension];
  }

  std::vector<std::string> replaced() const override {
    return {std::string(kCoreMember), "extensions/" + std::string(kSpecularExtension),
            "extensions/" + std::string(kIorExtension)};
  }

  MaterialEdit convert(SpanValue material, AssetMaterial& report) override {
    // The index bends light in these, and core has one index.
    for (const char* name : {"KHR_materials_volume", "KHR_materials_dispersion"})
      if (material["extensions"][name])
        throw input_error("has " + std::string(name) + ", which needs KHR_materials_ior (leave it as it is)");
    CoreMaterial read = read_core_material(material, report.warnings);
    read.has_dielectric = true;
    const CoreTexts texts = texts_of(read, report);
    report.residual = texts.residual;
    report.becomes =
        core_summary(texts, "base color map") + (texts.metal_rough_texture ? ", both times map" : "");
    MaterialEdit edit;
    edit.material = material;
    edit.core = core_members(texts);
    edit.removed_extensions = {kSpecularExtension, kIorExtension};
    if (texts.has_metal) edit.colored = "tinted its diffuse color and now tint its reflection, too";
    return edit;
  }

 private:
  // Constant maps are factors of `read` from here on.
  CoreTexts texts_of(CoreMaterial& read, AssetMaterial& report) {
    if (read.base_texture || read.metal_rough_texture || read.specular_texture ||
        read.specular_color_texture) {
      if (!textures_) throw input_error("has textures, and no library of images is given");
      const std::optional<CoreTexts> texts = textures_->folded(read, *converter_, report.warnings);
      if (texts) return *texts;
    }
    const MetalRoughFactors result = metal_rough_of(converted(*converter_, values_of(read.factors(), true)));
    report.factors = {reported("base_color", {result.base_color.begin(), result.base_color.end()}),
                      reported("metallic", {result.metallic}), reported("roughness", {result.roughness})};
    CoreTexts texts;
    for (std::size_t c = 0; c < 3; ++c) {
      const bool is_base = is_factor(result.base_color[c], read.base_color[c]);
      texts.base_color[c] =
          is_base ? read.base_color[c].text : factor_text(result.base_color[c], read.specular_color[c]);
    }
    texts.base_color[3] = read.base_color[3].text;
    texts.metallic = factor_text(result.metallic, read.metallic);
    texts.roughness = factor_text(result.roughness, read.roughness);
    texts.has_metal = result.metallic > 0.0f;
    texts.residual = static_cast<double>(result.residual);
    return texts;
  }

  std::unique_ptr<Converter> converter_;
  std::optional<CoreTextures> textures_;
};

}  // namespace

std::unique_ptr<GltfDirection> make_specular_fold(const DirectionParts& parts) {
  return std::make_unique<SpecularFold>(parts);
}

}  // namespace remap
