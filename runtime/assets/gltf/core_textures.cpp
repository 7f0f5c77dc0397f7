#include "assets/gltf/core_textures.hpp"

#include <utility>

#include "assets/maps/map_pixels.hpp"

namespace remap {
namespace {

constexpr std::string_view kDiffuseSuffix = "_diffuse", kSpecGlossSuffix = "_specularGlossiness";

// Takes a map of one value into factors.
template <typename Fold>
void fold_constant(std::optional<UsedTexture>& texture, const Fold& fold) {
  if (!texture || !is_constant(texture->pixels())) return;
  fold(first_texel(texture->pixels()));
  texture.reset();
}

void multiply_color(FactorText* factors, const std::array<float, 4>& texel) {
  for (std::size_t c = 0; c < 3; ++c) multiply(factors[c], linear_of_srgb(texel[c]));
}

const ImagePixels* pixels_of(const std::optional<UsedTexture>& texture) {
  return texture ? &texture->pixels() : nullptr;
}

}  // namespace

CoreMaps CoreUsed::maps(const CoreMaterial& material) const {
  return {pixels_of(base),           pixels_of(metal_rough), pixels_of(specular),
          pixels_of(specular_color), material.factors(),     material.has_dielectric};
}

std::string CoreUsed::key(const CoreMaterial& material) const {
  std::string key = texture_key(base) + " " + texture_key(metal_rough) + " " + texture_key(specular) + " " +
                    texture_key(specular_color) + (material.has_dielectric ? " F0" : "");
  const CoreFactors factors = material.factors();
  for (std::size_t c = 0; c < 3; ++c)
    key += " " + number_text(factors.base_color[c]) + " " + number_text(factors.specular_color[c]);
  for (const double value : {factors.metallic, factors.roughness, factors.f0_of_index, factors.specular})
    key += " " + number_text(value);
  return key;
}

const UsedTexture& CoreUsed::color_model() const {
  return base ? *base : specular_color ? *specular_color : metal_rough ? *metal_rough : *specular;
}

const UsedTexture& CoreUsed::data_model() const {
  return metal_rough ? *metal_rough : specular_color ? *specular_color : specular ? *specular : *base;
}

CoreUsed CoreTextures::load(CoreMaterial& material, bool needs_base, const GridReason& reason,
                            std::vector<std::string>& warnings) const {
  CoreUsed used;
  if (needs_base) used.base = textures_.load(material.base_texture, "base color");
  used.metal_rough = textures_.load(material.metal_rough_texture, "metallic-roughness", Transfer::kLinear);
  used.specular = textures_.load(material.specular_texture, "specular", Transfer::kLinear);
  used.specular_color = textures_.load(material.specular_color_texture, "specular color");
  fold_constant(used.base, [&](const std::array<float, 4>& texel) {
    multiply_color(material.base_color.data(), texel);
    multiply(material.base_color[3], texel[3]);
    material.base_texture = SpanValue();
  });
  fold_constant(used.metal_rough, [&](const std::array<float, 4>& texel) {
    multiply(material.roughness, texel[1]);
    multiply(material.metallic, texel[2]);
  });
  fold_constant(used.specular,
                [&](const std::array<float, 4>& texel) { multiply(material.specular, texel[3]); });
  fold_constant(used.specular_color, [&](const std::array<float, 4>& texel) {
    multiply_color(material.specular_color.data(), texel);
  });
  std::vector<UsedTexture*> all;
  for (std::optional<UsedTexture>* texture :
       {&used.base, &used.metal_rough, &used.specular_color, &used.specular})
    if (*texture) all.push_back(&**texture);
  textures_.align(all, reason, warnings);
  return used;
}

std::optional<SpecGlossTexts> CoreTextures::specgloss(CoreMaterial& material, const Converter& converter,
                                                      std::vector<std::string>& warnings) {
  // Diffuse of a dielectric is its base color, by the conventions of both.
  const bool is_dielectric = material.metallic.value == 0.0;
  if (is_dielectric && material.base_texture) (void)textures_.images().info_of(material.base_texture);
  const CoreUsed used = load(material, !is_dielectric, {"specular color", ""}, warnings);
  if (!used.base && !used.metal_rough && !used.specular && !used.specular_color) return std::nullopt;
  const auto [place, is_new] = to_specgloss_.try_emplace(used.key(material));
  ToSpecGloss& result = place->second;
  if (is_new) {
    result.images = specgloss_images(used.maps(material), converter);
    if (is_dielectric) result.images.diffuse.reset();
    if (const auto diffuse = std::exchange(result.images.diffuse, std::nullopt))
      result.diffuse_image = textures_.add_color(*diffuse, used.color_model(), used.base, kDiffuseSuffix);
    if (const auto specgloss = std::exchange(result.images.specgloss, std::nullopt))
      result.specgloss_image = textures_.add_data(*specgloss, used.data_model(), kSpecGlossSuffix);
  }
  SpecGlossTexts texts;
  const bool keeps_base = is_dielectric || result.images.keeps_base;
  for (std::size_t c = 0; c < 3; ++c) {
    texts.diffuse[c] = is_dielectric ? material.base_color[c].text
                                     : factor_text(result.images.diffuse_factors[c], material.base_color[c]);
    texts.specular[c] = factor_text(result.images.specular[c], material.base_color[c]);
  }
  FactorText alpha = material.base_color[3];
  multiply(alpha, result.images.alpha);
  texts.diffuse[3] = alpha.text;
  texts.glossiness = float_text(result.images.glossiness);
  if (result.diffuse_image)
    texts.diffuse_texture = textures_.text_of(used.color_model(), *result.diffuse_image);
  else if (keeps_base)
    texts.diffuse_texture = {material.base_texture, {}};
  if (result.specgloss_image)
    texts.specgloss_texture = textures_.text_of(used.data_model(), *result.specgloss_image);
  return texts;
}

std::optional<CoreTexts> CoreTextures::folded(CoreMaterial& material, const Converter& converter,
                                              std::vector<std::string>& warnings) {
  const CoreUsed used = load(material, true, {"metallic", ""}, warnings);
  if (!used.base && !used.metal_rough && !used.specular && !used.specular_color) return std::nullopt;
  const auto [place, is_new] = to_core_.try_emplace(used.key(material));
  ToCore& result = place->second;
  if (is_new) {
    result.maps = remap::folded(used.maps(material), converter);
    if (const auto base = std::exchange(result.maps.base_color, std::nullopt))
      result.base_image = textures_.add_color(*base, used.color_model(), used.base, kBaseSuffix);
    if (const auto data = std::exchange(result.maps.metal_rough, std::nullopt))
      result.metal_rough_image = textures_.add_data(*data, used.data_model(), kMetalRoughSuffix);
  }
  CoreTexts texts;
  for (std::size_t c = 0; c < 3; ++c)
    texts.base_color[c] = result.base_image ? std::string("1") : material.base_color[c].text;
  texts.base_color[3] = material.base_color[3].text;
  if (result.base_image)
    texts.base_texture = textures_.text_of(used.color_model(), *result.base_image);
  else
    texts.base_texture = {material.base_texture, {}};
  texts.metallic = float_text(result.maps.metallic);
  texts.roughness = float_text(result.maps.roughness);
  if (result.metal_rough_image)
    texts.metal_rough_texture = textures_.text_of(used.data_model(), *result.metal_rough_image);
  texts.has_metal = result.maps.has_metal;
  texts.residual = result.maps.residual;
  return texts;
}

}  // namespace remap
