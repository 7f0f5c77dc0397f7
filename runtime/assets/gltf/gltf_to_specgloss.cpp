// This file adds KHR_materials_pbrSpecularGlossiness to core materials. pbrMetallicRoughness stays for
// viewers that do not read the extension.
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "assets/gltf/gltf_workflow.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// A SpecGlossTexts holds the JSON of a spec-gloss material.
struct SpecGlossTexts {
  std::array<std::string, 4> diffuse;
  std::array<std::string, 3> specular;
  std::string glossiness;
  TextureText diffuse_texture, specgloss_texture;
};

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
  CoreToSpecGloss(const AssetOptions& options, MaterialTextures* textures)
      : textures_(textures),
        plain_(converter_of(GltfWorkflow::kMetalRough, "gltf-specgloss", options)),
        dielectric_(converter_of(GltfWorkflow::kDielectric, "gltf-specgloss", options)) {}

  // Skips unlit materials. They have no workflow, because KHR_materials_unlit reads base color.
  bool applies_to(SpanValue material) const override {
    const SpanValue extensions = material["extensions"];
    return material.is(SpanKind::kObject) && !extensions[kSpecGlossExtension] && !extensions[kUnlitExtension];
  }

  std::vector<std::string> replaced() const override {
    return {std::string(kCoreMember), "extensions/" + std::string(kSpecularExtension),
            "extensions/" + std::string(kIorExtension)};
  }

  MaterialEdit convert(SpanValue material, AssetMaterial& report) override {
    const SpanValue extensions = material["extensions"];
    const bool has_dielectric = extensions[kSpecularExtension] || extensions[kIorExtension];
    const GltfWorkflow workflow = has_dielectric ? GltfWorkflow::kDielectric : GltfWorkflow::kMetalRough;
    GltfMaterial read = read_material(material, workflow, report.warnings);
    require_alone(extensions);
    const SpecGlossTexts texts = texts_of(workflow, read, report);
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
    if (has_dielectric) {
      edit.removed_extensions = {kSpecularExtension, kIorExtension};
      report.warnings.emplace_back(
          "viewers without spec-gloss show this material with an index of refraction of 1.5, because glTF "
          "does not allow KHR_materials_specular and KHR_materials_ior together with spec-gloss");
    }
    if (read.number(GltfInput::kMetallic) > 0.0)
      edit.vertex_color_warning = "tinted its reflection and now tint only its diffuse color";
    return edit;
  }

 private:
  // Refuses extensions that change reflection, because viewers ignore them if spec-gloss is present.
  static void require_alone(SpanValue extensions) {
    for (const SpanValue& extension : extensions.children()) {
      const std::string name = extension.key();
      if (name == kSpecularExtension || name == kIorExtension) continue;
      if (is_reflecting(name) || !is_known_extension(name))
        throw input_error(
            "has " + plain(name) + ", which " +
            (is_reflecting(name) ? "viewers ignore in" : "is unknown and may have no effect in") +
            " spec-gloss materials (remove it from the material)");
    }
  }

  // A Made is the result for a set of images, with the numbers of new images. It holds no pixels.
  struct Made {
    SpecGlossMaps maps;
    std::optional<std::size_t> diffuse_image, specgloss_image;
  };

  const Converter& converter(GltfWorkflow workflow) const {
    return workflow == GltfWorkflow::kDielectric ? *dielectric_ : *plain_;
  }

  // Constant maps become factors of `material`.
  SpecGlossTexts texts_of(GltfWorkflow workflow, GltfMaterial& material, AssetMaterial& report) {
    // By the conventions of both workflows, a dielectric's diffuse is its base color.
    const bool keeps_base = material.number(GltfInput::kMetallic) == 0.0;
    std::span<const GltfInput> inputs = inputs_of(workflow);
    if (has_textures(material, inputs)) {
      if (keeps_base) inputs = inputs.subspan(1);
      const auto used = used_textures(textures_, material, inputs, {"specular color", ""}, report.warnings);
      if (keeps_base) textures_->require_readable(material[GltfInput::kBaseColor].texture);
      if (used) return texts_of_maps(workflow, material, *used, keeps_base);
    }
    return texts_of_factors(workflow, material, report);
  }

  SpecGlossTexts texts_of_factors(GltfWorkflow workflow, const GltfMaterial& material,
                                  AssetMaterial& report) const {
    const MaterialValues values = converted(converter(workflow), values_of(workflow, material));
    const std::vector<float>&diffuse = values.at(Parameter::kDiffuse),
          &specular = values.at(Parameter::kSpecular);
    const float glossiness = 1.0f - values.at(Parameter::kRoughness)[0];
    report.factors = {reported("diffuse", diffuse), reported("specular", specular),
                      reported("glossiness", {glossiness})};
    const auto &base = material[GltfInput::kBaseColor].factor,
               &specular_color = material[GltfInput::kSpecularColor].factor;
    const bool keeps_base = material.number(GltfInput::kMetallic) == 0.0;
    SpecGlossTexts texts;
    for (std::size_t c = 0; c < 3; ++c) {
      texts.diffuse[c] = keeps_base ? base[c].text : factor_text(diffuse[c], base[c]);
      texts.specular[c] =
          is_factor(specular[c], base[c]) ? base[c].text : factor_text(specular[c], specular_color[c]);
    }
    texts.diffuse[3] = base[3].text;
    texts.glossiness = float_text(glossiness);
    if (keeps_base) texts.diffuse_texture = {material[GltfInput::kBaseColor].texture, {}};
    return texts;
  }

  SpecGlossTexts texts_of_maps(GltfWorkflow workflow, const GltfMaterial& material, const UsedTextures& used,
                               bool keeps_base) {
    GltfMaps maps(workflow, material, used);
    const auto [place, is_new] = made_.try_emplace(maps.key);
    Made& made = place->second;
    if (is_new) {
      const MaterialValues first = converted(converter(workflow), first_values_of(workflow, material, used));
      made.maps = specgloss_maps(converter(workflow), std::move(maps.sources), first);
      if (keeps_base) made.maps.diffuse.reset();
      if (const auto diffuse = std::exchange(made.maps.diffuse, std::nullopt))
        made.diffuse_image =
            textures_->add_color(*diffuse, maps.color_model, used.of(GltfInput::kBaseColor), "_diffuse");
      if (const auto specgloss = std::exchange(made.maps.specgloss, std::nullopt))
        made.specgloss_image = textures_->add_data(*specgloss, maps.data_model, "_specularGlossiness");
    }
    const auto& base = material[GltfInput::kBaseColor].factor;
    SpecGlossTexts texts;
    for (std::size_t c = 0; c < 3; ++c) {
      texts.diffuse[c] = keeps_base ? base[c].text : factor_text(made.maps.diffuse_factors[c], base[c]);
      texts.specular[c] = factor_text(made.maps.specular[c], base[c]);
    }
    texts.diffuse[3] =
        made.maps.alpha == 1.0f
            ? base[3].text
            : float_text(static_cast<float>(base[3].value * static_cast<double>(made.maps.alpha)));
    texts.glossiness = float_text(made.maps.glossiness);
    if (made.diffuse_image)
      texts.diffuse_texture = textures_->text_of(maps.color_model, *made.diffuse_image);
    else if (keeps_base || made.maps.keeps_color)
      texts.diffuse_texture = {material[GltfInput::kBaseColor].texture, {}};
    if (made.specgloss_image)
      texts.specgloss_texture = textures_->text_of(maps.data_model, *made.specgloss_image);
    return texts;
  }

  MaterialTextures* textures_;  // null if no images can be read
  std::unique_ptr<Converter> plain_, dielectric_;
  std::map<std::string, Made> made_;  // keyed by GltfMaps::key
};

}  // namespace

std::unique_ptr<GltfDirection> make_core_to_specgloss(const AssetOptions& options,
                                                      MaterialTextures* textures) {
  return std::make_unique<CoreToSpecGloss>(options, textures);
}

}  // namespace remap
