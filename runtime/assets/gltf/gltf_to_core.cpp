// This file converts materials to core metallic-roughness: those of KHR_materials_pbrSpecularGlossiness (an
// archived extension of Khronos), and those whose KHR_materials_specular and KHR_materials_ior are folded
// into core. A folded material is first converted to spec-gloss, and from there to core by the projection.
// One converter does both. Materials with equal images and factors share the result.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "assets/gltf/gltf_workflow.hpp"
#include "assets/maps/map_pixels.hpp"
#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// A CoreTexts holds the JSON texts of a material in core glTF, and with --extensions write also of
// KHR_materials_specular.
struct CoreTexts {
  std::array<std::string, 4> base_color;
  std::string metallic, roughness;
  TextureText base_texture, metal_rough_texture;
  TextureText specular_texture;
  bool has_metal = false;  // true if metallic is above 0 anywhere
  double residual = 0.0;   // Parameter::kResidual; for maps the root of its mean square
};

// A CoreMaker makes core glTF of materials of any workflow.
class CoreMaker {
 public:
  // `textures` must outlive this object.
  CoreMaker(const AssetOptions& options, MaterialTextures* textures, GltfWorkflow workflow, GridReason reason)
      : textures_(textures),
        workflow_(workflow),
        reason_(reason),
        converter_(converter_of(workflow, "gltf", options)) {}

  // Converts a material. Constant maps become factors of `material`. Throws kInput for maps that cannot be
  // read or do not lie on one grid.
  CoreTexts convert(GltfMaterial& material, AssetMaterial& report);

 private:
  // A Made is the result for a set of images. It has the indices of the new images, but not their pixels.
  struct Made {
    MetalRoughMaps maps;
    std::optional<std::size_t> base_image, metal_rough_image;
  };

  CoreTexts of_factors(const GltfMaterial& material, AssetMaterial& report) const;
  CoreTexts of_maps(const GltfMaterial& material, const UsedTextures& used);

  MaterialTextures* textures_;  // null if no images can be read
  GltfWorkflow workflow_;
  GridReason reason_;
  std::unique_ptr<Converter> converter_;
  std::map<std::string, Made> made_;  // keyed by GltfMaps::key
};

// Returns the text of the first factor that equals the value.
std::string text_among(float value, const FactorText& first, const FactorText& second) {
  return is_factor(value, first) ? first.text : factor_text(value, second);
}

// Returns the color input that base color can be made from, if it is not base color.
GltfInput other_color_of(GltfWorkflow workflow) {
  return workflow == GltfWorkflow::kSpecGloss ? GltfInput::kSpecGlossSpecular : GltfInput::kSpecularColor;
}

// Returns all members of pbrMetallicRoughness.
std::vector<MemberText> core_members(const CoreTexts& texts) {
  return {{"baseColorFactor", list_text({texts.base_color.begin(), texts.base_color.end()}), {}},
          {"baseColorTexture", "", texts.base_texture},
          {"metallicFactor", texts.metallic, {}},
          {"roughnessFactor", texts.roughness, {}},
          {"metallicRoughnessTexture", "", texts.metal_rough_texture}};
}

// Describes a material: `base color map times 1 1 1, metallic 0, roughness 1`. `kept` is the word for a map
// that does not change.
std::string core_summary(const CoreTexts& texts, const std::string& kept) {
  std::string text = "base color ";
  if (texts.base_texture) text += (texts.base_texture.added ? "map" : kept) + " times ";
  text += texts.base_color[0] + " " + texts.base_color[1] + " " + texts.base_color[2];
  if (texts.base_color[3] != "1") text += ", alpha " + texts.base_color[3];
  text += ", metallic " + texts.metallic + ", roughness " + texts.roughness;
  return text;
}

CoreTexts CoreMaker::convert(GltfMaterial& material, AssetMaterial& report) {
  const std::span<const GltfInput> inputs = inputs_of(workflow_);
  if (has_textures(material, inputs))
    if (const auto used = used_textures(textures_, material, inputs, reason_, report.warnings))
      return of_maps(material, *used);
  return of_factors(material, report);
}

CoreTexts CoreMaker::of_factors(const GltfMaterial& material, AssetMaterial& report) const {
  const MaterialValues result = converted(*converter_, values_of(workflow_, material));
  const std::vector<float>& base = result.at(Parameter::kBaseColor);
  const float metallic = result.at(Parameter::kMetallic)[0], roughness = result.at(Parameter::kRoughness)[0];
  report.factors = {reported("base_color", base), reported("metallic", {metallic}),
                    reported("roughness", {roughness})};
  const auto &color = material[color_of(workflow_)].factor,
             &other = material[other_color_of(workflow_)].factor;
  CoreTexts texts;
  for (std::size_t c = 0; c < 3; ++c) texts.base_color[c] = text_among(base[c], color[c], other[c]);
  texts.base_color[3] = color[3].text;
  texts.metallic = factor_text(metallic, material[GltfInput::kMetallic].factor[0]);
  texts.roughness = factor_text(roughness, material[GltfInput::kRoughness].factor[0]);
  texts.has_metal = metallic > 0.0f;
  texts.residual = static_cast<double>(result.at(Parameter::kResidual)[0]);
  return texts;
}

CoreTexts CoreMaker::of_maps(const GltfMaterial& material, const UsedTextures& used) {
  const GltfInput color = color_of(workflow_);
  GltfMaps maps(workflow_, material, used);
  const auto [place, is_new] = made_.try_emplace(maps.key);
  Made& made = place->second;
  if (is_new) {
    made.maps = metal_rough_maps(*converter_, std::move(maps.sources));
    if (const auto base = std::exchange(made.maps.base_color, std::nullopt))
      made.base_image = textures_->add_color(*base, maps.color_model, used.of(color), "_baseColor");
    if (const auto data = std::exchange(made.maps.metal_rough, std::nullopt))
      made.metal_rough_image = textures_->add_data(*data, maps.data_model, "_metallicRoughness");
  }
  CoreTexts texts;
  for (std::size_t c = 0; c < 4; ++c)
    texts.base_color[c] = made.base_image && c < 3 ? std::string("1") : material[color].factor[c].text;
  texts.base_texture = made.base_image ? textures_->text_of(maps.color_model, *made.base_image)
                                       : TextureText{material[color].texture, {}};
  texts.metallic = float_text(made.maps.metallic);
  texts.roughness = float_text(made.maps.roughness);
  if (made.metal_rough_image)
    texts.metal_rough_texture = textures_->text_of(maps.data_model, *made.metal_rough_image);
  texts.has_metal = made.maps.has_metal;
  texts.residual = made.maps.residual;
  return texts;
}

// Adds a warning for values of the extension that core glTF has no place for.
void note_lost_members(SpanValue extension, std::vector<std::string>& warnings) {
  constexpr std::array<std::string_view, 6> kRead = {"diffuseFactor",    "diffuseTexture",
                                                     "specularFactor",   "specularGlossinessTexture",
                                                     "glossinessFactor", "extras"};
  for (const SpanValue& member : extension.children()) {
    const std::string name = member.key();
    if (contains(kRead, name)) continue;
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

class SpecularFold final : public GltfDirection {
 public:
  SpecularFold(const AssetOptions& options, MaterialTextures* textures)
      : maker_(options, textures, GltfWorkflow::kDielectric, {"metallic", ""}) {}

  bool applies_to(SpanValue material) const override {
    const SpanValue extensions = material["extensions"];
    return (extensions[kSpecularExtension] || extensions[kIorExtension]) &&
           !extensions[kSpecGlossExtension] && !extensions[kUnlitExtension];
  }

  std::vector<std::string> replaced() const override {
    return {std::string(kCoreMember), "extensions/" + std::string(kSpecularExtension),
            "extensions/" + std::string(kIorExtension)};
  }

  MaterialEdit convert(SpanValue material, AssetMaterial& report) override {
    // These extensions also use the index to bend light. Core glTF always has the index 1.5.
    for (const char* name : {"KHR_materials_volume", "KHR_materials_dispersion"})
      if (material["extensions"][name])
        throw input_error("has " + std::string(name) +
                          ", which needs KHR_materials_ior (convert it without --extensions fold)");
    GltfMaterial read = read_material(material, GltfWorkflow::kDielectric, report.warnings);
    const CoreTexts texts = maker_.convert(read, report);
    report.residual = texts.residual;
    report.becomes =
        core_summary(texts, "base color map") + (texts.metal_rough_texture ? ", both times map" : "");
    MaterialEdit edit;
    edit.material = material;
    edit.core = core_members(texts);
    edit.removed_extensions = {kSpecularExtension, kIorExtension};
    if (texts.has_metal)
      edit.vertex_color_warning = "tinted its diffuse color and now tint its reflection, too";
    return edit;
  }

 private:
  CoreMaker maker_;
};

}  // namespace

std::unique_ptr<GltfDirection> make_specgloss_to_core(const AssetOptions& options,
                                                      MaterialTextures* textures) {
  return std::make_unique<SpecGlossToCore>(options, textures);
}

std::unique_ptr<GltfDirection> make_specular_fold(const AssetOptions& options, MaterialTextures* textures) {
  return std::make_unique<SpecularFold>(options, textures);
}

}  // namespace remap
