// Spec-gloss materials become core metallic-roughness (KHR_materials_pbrSpecularGlossiness, an archived
// extension of Khronos).
#include <algorithm>
#include <array>
#include <memory>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/core_material.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "assets/gltf/specgloss_material.hpp"
#include "assets/gltf/specgloss_textures.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

SpecGlossMaterial read_specgloss(SpanValue material, std::vector<std::string>& warnings) {
  SpecGlossMaterial read;
  read.material = material;
  const SpanValue extensions = material["extensions"];
  read.extension = extensions[kSpecGlossExtension];
  if (!read.extension.is(SpanKind::kObject))
    throw input_error(std::string(kSpecGlossExtension) + ": expected an object");
  if (const SpanValue core = material[kCoreMember]; core && !core.is(SpanKind::kObject))
    throw input_error(std::string(kCoreMember) + ": expected an object");
  const FactorReader factors(read.extension, warnings);
  factors.read("diffuseFactor", read.diffuse);
  factors.read("specularFactor", read.specular);
  factors.read("glossinessFactor", read.glossiness);
  read.diffuse_texture = read.extension["diffuseTexture"];
  read.specgloss_texture = read.extension["specularGlossinessTexture"];
  read.is_unlit = static_cast<bool>(extensions[kUnlitExtension]);
  return read;
}

// Names what the extension holds and core has no place for.
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

// A channel of base color: the text of diffuse or specular where it is that number.
std::string base_text(float base, const FactorText& diffuse, const FactorText& specular) {
  return is_factor(base, diffuse) ? diffuse.text : factor_text(base, specular);
}

class SpecGlossToCore final : public GltfDirection {
 public:
  explicit SpecGlossToCore(const DirectionParts& parts)
      : options_(parts.options),
        projection_(specgloss_projection(parts.options.prior, parts.options.instructions)) {
    if (parts.textures != nullptr)
      textures_ = std::make_unique<SpecGlossTextures>(*parts.textures, *projection_);
  }

  bool takes(SpanValue material) const override {
    return static_cast<bool>(material["extensions"][kSpecGlossExtension]);
  }

  std::vector<std::string> replaced() const override {
    return {std::string(kCoreMember), "extensions/" + std::string(kSpecGlossExtension)};
  }

  MaterialEdit convert(SpanValue material, AssetMaterial& report) override {
    SpecGlossMaterial read = read_specgloss(material, report.warnings);
    const bool is_exact = options_.profile == MaterialProfile::kExtensions && !read.is_unlit;
    if (is_exact) require_exact_form(material);
    const CoreTexts texts = texts_of(read, is_exact, report);
    report.residual = texts.residual;
    report.becomes = summary(texts, read, is_exact);
    note_lost_members(read.extension, report.warnings);
    return edit_of(read, texts, is_exact, report);
  }

 private:
  static void require_exact_form(SpanValue material) {
    for (const std::string_view name : {kSpecularExtension, kIorExtension})
      if (material["extensions"][name])
        throw input_error("has " + std::string(name) +
                          " already, which the exact form needs (use --profile core)");
  }

  // Constant maps are factors of `read` from here on.
  CoreTexts texts_of(SpecGlossMaterial& read, bool is_exact, AssetMaterial& report) const {
    if (!read.is_unlit && (read.diffuse_texture || read.specgloss_texture)) {
      if (!textures_) throw input_error("has textures, and no library of images is given");
      const std::optional<CoreTexts> texts =
          is_exact ? textures_->exact(read) : textures_->core(read, report.warnings);
      if (texts) return *texts;
    }
    MetalRoughFactors result = projected(read.factors(), *projection_);
    const bool keeps_diffuse = is_exact || read.is_unlit;
    if (keeps_diffuse) {
      for (std::size_t c = 0; c < 3; ++c) result.base_color[c] = static_cast<float>(read.diffuse[c].value);
      result.metallic = result.residual = 0.0f;
    }
    report.factors = {reported("base_color", {result.base_color.begin(), result.base_color.end()}),
                      reported("metallic", {result.metallic}), reported("roughness", {result.roughness})};
    CoreTexts texts;
    for (std::size_t c = 0; c < 3; ++c)
      texts.base_color[c] = keeps_diffuse
                                ? read.diffuse[c].text
                                : base_text(result.base_color[c], read.diffuse[c], read.specular[c]);
    texts.base_color[3] = read.diffuse[3].text;
    texts.metallic = float_text(result.metallic);
    texts.roughness = float_text(result.roughness);
    texts.has_metal = result.metallic > 0.0f;
    texts.residual = static_cast<double>(result.residual);
    if (read.is_unlit) texts.base_texture = {read.diffuse_texture, {}};
    return texts;
  }

  static std::string summary(const CoreTexts& texts, const SpecGlossMaterial& read, bool is_exact) {
    std::string text = core_summary(texts, "diffuse map");
    if (read.is_unlit) return text.substr(0, text.find(", metallic")) + ", unlit";
    if (texts.metal_rough_texture) text += is_exact ? " times map" : ", both times map";
    if (is_exact)
      text += std::string(", specular color ") + (texts.specular_texture ? "map times " : "") +
              read.specular[0].text + " " + read.specular[1].text + " " + read.specular[2].text;
    return text;
  }

  MaterialEdit edit_of(const SpecGlossMaterial& read, const CoreTexts& texts, bool is_exact,
                       AssetMaterial& report) const {
    MaterialEdit edit;
    edit.material = read.material;
    edit.core = core_members(texts);
    edit.removed_extensions = {kSpecGlossExtension};
    edit.carried_extras = read.extension["extras"];
    if (texts.has_metal) edit.colored = "tinted its diffuse color and now tint its reflection, too";
    if (is_exact) {
      const std::string color =
          list_text({read.specular[0].text, read.specular[1].text, read.specular[2].text});
      edit.added_extensions = {
          {kSpecularExtension,
           {{"specularColorFactor", color, {}}, {"specularColorTexture", "", texts.specular_texture}}},
          // An index of 0 means an F0 of 1, which the color then multiplies (KHR_materials_ior).
          {kIorExtension, {{"ior", "0", {}}}}};
    }
    for (const SpanValue& extension : read.material["extensions"].children()) {
      const std::string name = extension.key();
      if (!is_reflecting(name)) continue;
      // Converting the file again would fold extensions that spec-gloss viewers ignored.
      if (options_.folds_specular && (name == kSpecularExtension || name == kIorExtension))
        edit.removed_extensions.push_back(name == kIorExtension ? kIorExtension : kSpecularExtension);
      else
        report.warnings.push_back(name + ", ignored beside spec-gloss, takes effect from now on");
    }
    return edit;
  }

  const AssetOptions& options_;
  std::unique_ptr<Converter> projection_;
  std::unique_ptr<SpecGlossTextures> textures_;
};

}  // namespace

std::unique_ptr<GltfDirection> make_specgloss_to_core(const DirectionParts& parts) {
  return std::make_unique<SpecGlossToCore>(parts);
}

}  // namespace remap
