// Core materials get KHR_materials_pbrSpecularGlossiness. pbrMetallicRoughness stays: it is the fallback of
// viewers that do not read the extension.
#include <array>
#include <memory>
#include <optional>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/core_material.hpp"
#include "assets/gltf/core_textures.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

std::string color_text(const std::array<std::string, 3>& color) {
  return color[0] + " " + color[1] + " " + color[2];
}

std::string specgloss_summary(const SpecGlossTexts& texts) {
  std::string text = "diffuse ";
  if (texts.diffuse_texture) text += texts.diffuse_texture.added ? "map times " : "base color map times ";
  text += color_text({texts.diffuse[0], texts.diffuse[1], texts.diffuse[2]});
  if (texts.diffuse[3] != "1") text += ", alpha " + texts.diffuse[3];
  text += ", specular " + color_text(texts.specular) + ", glossiness " + texts.glossiness;
  if (texts.specgloss_texture) text += ", both times map";
  return text;
}

class CoreToSpecGloss final : public GltfDirection {
 public:
  explicit CoreToSpecGloss(const DirectionParts& parts)
      : plain_(make_core_converter("gltf-specgloss", false, parts.options.prior, parts.options.instructions)),
        dielectric_(
            make_core_converter("gltf-specgloss", true, parts.options.prior, parts.options.instructions)) {
    if (parts.textures != nullptr) textures_.emplace(*parts.textures);
  }

  // Unlit materials have no workflow: KHR_materials_unlit reads base color.
  bool takes(SpanValue material) const override {
    const SpanValue extensions = material["extensions"];
    return material.is(SpanKind::kObject) && !extensions[kSpecGlossExtension] && !extensions[kUnlitExtension];
  }

  std::vector<std::string> replaced() const override {
    return {std::string(kCoreMember), "extensions/" + std::string(kSpecularExtension),
            "extensions/" + std::string(kIorExtension)};
  }

  MaterialEdit convert(SpanValue material, AssetMaterial& report) override {
    CoreMaterial read = read_core_material(material, report.warnings);
    require_alone(material["extensions"]);
    const SpecGlossTexts texts = texts_of(read, report);
    report.becomes = specgloss_summary(texts);
    MaterialEdit edit;
    edit.material = material;
    const std::string specular = list_text({texts.specular.begin(), texts.specular.end()});
    edit.added_extensions = {{kSpecGlossExtension,
                              {{"diffuseFactor", list_text({texts.diffuse.begin(), texts.diffuse.end()}), {}},
                               {"diffuseTexture", "", texts.diffuse_texture},
                               {"specularFactor", specular, {}},
                               {"glossinessFactor", texts.glossiness, {}},
                               {"specularGlossinessTexture", "", texts.specgloss_texture}}}};
    if (read.has_dielectric) {
      edit.removed_extensions = {kSpecularExtension, kIorExtension};
      report.warnings.emplace_back(
          "viewers without spec-gloss show its fallback with an index of 1.5, because KHR_materials_specular "
          "and _ior must not stand beside spec-gloss");
    }
    if (read.metallic.value > 0.0) edit.colored = "tinted its reflection and now tint only its diffuse color";
    return edit;
  }

 private:
  // Beside spec-gloss, viewers ignore extensions that change what a material reflects.
  static void require_alone(SpanValue extensions) {
    for (const SpanValue& extension : extensions.children()) {
      const std::string name = extension.key();
      if (name == kSpecularExtension || name == kIorExtension) continue;
      if (is_reflecting(name) || !is_known_extension(name))
        throw input_error(
            "has " + plain(name) + ", which " +
            (is_reflecting(name) ? "viewers ignore" : "is unknown here and may have no meaning") +
            " beside spec-gloss (remove it, or leave the material as it is)");
    }
  }

  // Constant maps are factors of `read` from here on.
  SpecGlossTexts texts_of(CoreMaterial& read, AssetMaterial& report) {
    const Converter& converter = read.has_dielectric ? *dielectric_ : *plain_;
    if (read.base_texture || read.metal_rough_texture || read.specular_texture ||
        read.specular_color_texture) {
      if (!textures_) throw input_error("has textures, and no library of images is given");
      const std::optional<SpecGlossTexts> texts = textures_->specgloss(read, converter, report.warnings);
      if (texts) return *texts;
    }
    const MaterialValues values = converted(converter, values_of(read.factors(), read.has_dielectric));
    const std::vector<float>&diffuse = values.at(Parameter::kDiffuse),
          &specular = values.at(Parameter::kSpecular);
    const float glossiness = 1.0f - values.at(Parameter::kRoughness)[0];
    report.factors = {reported("diffuse", diffuse), reported("specular", specular),
                      reported("glossiness", {glossiness})};
    SpecGlossTexts texts;
    for (std::size_t c = 0; c < 3; ++c) {
      // Diffuse of a dielectric is its base color, by the conventions of both.
      texts.diffuse[c] =
          read.metallic.value == 0.0 ? read.base_color[c].text : factor_text(diffuse[c], read.base_color[c]);
      texts.specular[c] = is_factor(specular[c], read.base_color[c])
                              ? read.base_color[c].text
                              : factor_text(specular[c], read.specular_color[c]);
    }
    texts.diffuse[3] = read.base_color[3].text;
    texts.glossiness = float_text(glossiness);
    if (read.metallic.value == 0.0) texts.diffuse_texture = {read.base_texture, {}};
    return texts;
  }

  std::unique_ptr<Converter> plain_, dielectric_;
  std::optional<CoreTextures> textures_;
};

}  // namespace

std::unique_ptr<GltfDirection> make_core_to_specgloss(const DirectionParts& parts) {
  return std::make_unique<CoreToSpecGloss>(parts);
}

}  // namespace remap
