#include "assets/gltf/core_maker.hpp"

#include <utility>

namespace remap {
namespace {

// Returns the text of the first factor that equals the value.
std::string text_among(float value, const FactorText& first, const FactorText& second) {
  return is_factor(value, first) ? first.text : factor_text(value, second);
}

// Returns the color input that base color can be made from, if it is not base color.
GltfInput other_color_of(GltfWorkflow workflow) {
  return workflow == GltfWorkflow::kSpecGloss ? GltfInput::kSpecGlossSpecular : GltfInput::kSpecularColor;
}

}  // namespace

std::vector<MemberText> core_members(const CoreTexts& texts) {
  return {{"baseColorFactor", list_text({texts.base_color.begin(), texts.base_color.end()}), {}},
          {"baseColorTexture", "", texts.base_texture},
          {"metallicFactor", texts.metallic, {}},
          {"roughnessFactor", texts.roughness, {}},
          {"metallicRoughnessTexture", "", texts.metal_rough_texture}};
}

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

}  // namespace remap
