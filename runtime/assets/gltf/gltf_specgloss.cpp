// This file converts spec-gloss materials to core metallic-roughness (KHR_materials_pbrSpecularGlossiness, an
// archived extension of Khronos).
#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/core_maker.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "assets/maps/map_pixels.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// Adds a warning for values of the extension that core glTF has no place for.
void note_lost_members(SpanValue extension, std::vector<std::string>& warnings) {
  constexpr std::array<std::string_view, 6> kRead = {"diffuseFactor",    "diffuseTexture",
                                                     "specularFactor",   "specularGlossinessTexture",
                                                     "glossinessFactor", "extras"};
  for (const SpanValue& member : extension.children()) {
    const std::string name = member.key();
    if (std::ranges::find(kRead, name) != kRead.end()) continue;
    std::string inner;
    if (name == "extensions")
      for (const SpanValue& own : member.children())
        inner += (inner.empty() ? " (" : ", ") + plain(own.key());
    warnings.push_back("loses " + plain(name) + (inner.empty() ? "" : inner + ")") + " of " +
                       std::string(kSpecGlossExtension));
  }
}

// Returns the texts of a material that keeps diffuse as base color.
CoreTexts texts_of_diffuse(const GltfMaterial& material) {
  CoreTexts texts;
  const GltfValue& diffuse = material[GltfInput::kDiffuse];
  for (std::size_t c = 0; c < 4; ++c) texts.base_color[c] = diffuse.factor[c].text;
  texts.base_texture = {diffuse.texture, {}};
  texts.metallic = "0";
  texts.roughness = float_text(roughness_of(material.number(GltfInput::kGlossiness)));
  return texts;
}

class SpecGlossToCore final : public GltfDirection {
 public:
  SpecGlossToCore(const AssetOptions& options, MaterialTextures* textures)
      : options_(options),
        textures_(textures),
        maker_(options, textures, GltfWorkflow::kSpecGloss, {"metallic", ", or --extensions write"}) {}

  bool applies_to(SpanValue material) const override {
    return static_cast<bool>(material["extensions"][kSpecGlossExtension]);
  }

  std::vector<std::string> replaced() const override {
    return {std::string(kCoreMember), "extensions/" + std::string(kSpecGlossExtension)};
  }

  MaterialEdit convert(SpanValue material, AssetMaterial& report) override {
    GltfMaterial read = read_material(material, GltfWorkflow::kSpecGloss, report.warnings);
    const bool is_unlit = static_cast<bool>(material["extensions"][kUnlitExtension]);
    const bool is_exact = options_.writes_extensions() && !is_unlit;
    if (is_exact) require_exact_form(material);
    const CoreTexts texts = is_unlit   ? unlit(read, report)
                            : is_exact ? exact(read, report)
                                       : maker_.convert(read, report);
    report.residual = texts.residual;
    report.becomes = summary(texts, read, is_unlit, is_exact);
    note_lost_members(extension_of(material), report.warnings);
    return edit_of(read, texts, is_exact, report);
  }

 private:
  static SpanValue extension_of(SpanValue material) { return material["extensions"][kSpecGlossExtension]; }

  static void require_exact_form(SpanValue material) {
    for (const std::string_view name : {kSpecularExtension, kIorExtension})
      if (material["extensions"][name])
        throw input_error("has " + std::string(name) +
                          " already, but --extensions write would have to add this extension (convert the "
                          "file without --extensions)");
  }

  static void report_factors(const GltfMaterial& material, AssetMaterial& report) {
    const std::array<double, 3> diffuse = material.color(GltfInput::kDiffuse);
    report.factors = {reported("base_color", {diffuse.begin(), diffuse.end()}), reported("metallic", {0.0f}),
                      reported("roughness", {roughness_of(material.number(GltfInput::kGlossiness))})};
  }

  static CoreTexts unlit(const GltfMaterial& material, AssetMaterial& report) {
    report_factors(material, report);
    return texts_of_diffuse(material);
  }

  // Returns the exact result for a material without specular color. Only its roughness needs a new image.
  CoreTexts exact(const GltfMaterial& material, AssetMaterial& report) {
    CoreTexts texts = texts_of_diffuse(material);
    if (!has_textures(material, inputs_of(GltfWorkflow::kSpecGloss))) {
      report_factors(material, report);
      return texts;
    }
    require_images(textures_).require_readable(material[GltfInput::kDiffuse].texture);
    const SpanValue info = material[GltfInput::kGlossiness].texture;
    if (!info) return texts;
    const UsedTexture specgloss = textures_->load(info, GltfInput::kSpecGlossSpecular);
    texts.specular_texture = {info, {}};
    if (!specgloss.pixels().has_alpha()) return texts;
    const double glossiness = material.number(GltfInput::kGlossiness);
    const std::string key = std::to_string(specgloss.image.image) + " " + number_text(glossiness);
    if (!roughness_maps_.contains(key)) {
      const ImagePixels map = roughness_map(specgloss.pixels(), glossiness);
      if (is_constant(map)) {
        texts.roughness = float_text(first_texel(map)[1]);
        return texts;
      }
      roughness_maps_[key] = textures_->add_data(map, specgloss, "_roughness");
    }
    texts.metal_rough_texture = textures_->text_of(specgloss, roughness_maps_[key]);
    texts.roughness = "1";
    return texts;
  }

  static std::string summary(const CoreTexts& texts, const GltfMaterial& read, bool is_unlit, bool is_exact) {
    std::string text = core_summary(texts, "diffuse map");
    if (is_unlit) return text.substr(0, text.find(", metallic")) + ", unlit";
    if (texts.metal_rough_texture) text += is_exact ? " times map" : ", both times map";
    const auto& specular = read[GltfInput::kSpecGlossSpecular].factor;
    if (is_exact)
      text += std::string(", specular color ") + (texts.specular_texture ? "map times " : "") +
              specular[0].text + " " + specular[1].text + " " + specular[2].text;
    return text;
  }

  MaterialEdit edit_of(const GltfMaterial& read, const CoreTexts& texts, bool is_exact,
                       AssetMaterial& report) const {
    MaterialEdit edit;
    edit.material = read.text;
    edit.core = core_members(texts);
    edit.removed_extensions = {kSpecGlossExtension};
    edit.carried_extras = extension_of(read.text)["extras"];
    if (texts.has_metal)
      edit.vertex_color_warning = "tinted its diffuse color and now tint its reflection, too";
    if (is_exact) {
      const auto& specular = read[GltfInput::kSpecGlossSpecular].factor;
      const std::string color = list_text({specular[0].text, specular[1].text, specular[2].text});
      edit.added_extensions = {
          {kSpecularExtension,
           {{"specularColorFactor", color, {}}, {"specularColorTexture", "", texts.specular_texture}}},
          // An index of 0 sets F0 to 1, which the color then multiplies (KHR_materials_ior).
          {kIorExtension, {{"ior", "0", {}}}}};
    }
    for (const SpanValue& extension : read.text["extensions"].children()) {
      const std::string name = extension.key();
      if (!is_reflecting(name)) continue;
      // Viewers of spec-gloss ignore these extensions. If they stayed, a second conversion of the file would
      // fold them.
      if (options_.folds_extensions() && (name == kSpecularExtension || name == kIorExtension))
        edit.removed_extensions.push_back(name == kIorExtension ? kIorExtension : kSpecularExtension);
      else
        report.warnings.push_back(
            name + " takes effect now, because importers ignore it only in spec-gloss materials");
    }
    return edit;
  }

  const AssetOptions& options_;
  MaterialTextures* textures_;  // null if no images can be read
  CoreMaker maker_;
  std::map<std::string, std::size_t> roughness_maps_;  // keyed by image and factor
};

}  // namespace

std::unique_ptr<GltfDirection> make_specgloss_to_core(const AssetOptions& options,
                                                      MaterialTextures* textures) {
  return std::make_unique<SpecGlossToCore>(options, textures);
}

}  // namespace remap
