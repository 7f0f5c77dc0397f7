#include "assets/gltf/specgloss_textures.hpp"

#include <utility>

#include "assets/maps/map_pixels.hpp"

namespace remap {
namespace {

constexpr std::string_view kRoughnessSuffix = "_roughness";

void fold_diffuse(const ImagePixels& pixels, SpecGlossMaterial& material) {
  const std::array<float, 4> texel = first_texel(pixels);
  for (std::size_t c = 0; c < 3; ++c) multiply(material.diffuse[c], linear_of_srgb(texel[c]));
  multiply(material.diffuse[3], texel[3]);
}

void fold_specgloss(const ImagePixels& pixels, SpecGlossMaterial& material) {
  const std::array<float, 4> texel = first_texel(pixels);
  for (std::size_t c = 0; c < 3; ++c) multiply(material.specular[c], linear_of_srgb(texel[c]));
  multiply(material.glossiness, texel[3]);
}

// Tells factors apart. Alpha is copied, not converted.
std::string factor_key(const SpecGlossMaterial& material) {
  std::string key;
  for (std::size_t c = 0; c < 3; ++c)
    key += " " + number_text(material.diffuse[c].value) + " " + number_text(material.specular[c].value);
  return key + " " + number_text(material.glossiness.value);
}

}  // namespace

const SpecGlossTextures::Converted& SpecGlossTextures::converted(const std::optional<UsedTexture>& diffuse,
                                                                 const std::optional<UsedTexture>& specgloss,
                                                                 const SpecGlossMaterial& material) {
  const std::string key = texture_key(diffuse) + " " + texture_key(specgloss) + factor_key(material);
  const auto [place, is_new] = converted_.try_emplace(key);
  Converted& result = place->second;
  if (!is_new) return result;
  result.maps = projected({diffuse ? &diffuse->pixels() : nullptr, specgloss ? &specgloss->pixels() : nullptr,
                           material.factors()},
                          projection_);
  if (const auto base = std::exchange(result.maps.base_color, std::nullopt))
    result.base_image = textures_.add_color(*base, diffuse ? *diffuse : *specgloss, diffuse, kBaseSuffix);
  if (const auto data = std::exchange(result.maps.metal_rough, std::nullopt))
    result.metal_rough_image =
        textures_.add_data(*data, specgloss ? *specgloss : *diffuse, kMetalRoughSuffix);
  return result;
}

std::optional<CoreTexts> SpecGlossTextures::core(SpecGlossMaterial& material,
                                                 std::vector<std::string>& warnings) {
  std::optional<UsedTexture> diffuse = textures_.load(material.diffuse_texture, "diffuse"),
                             specgloss = textures_.load(material.specgloss_texture, "specular-glossiness");
  if (diffuse && is_constant(diffuse->pixels())) {
    fold_diffuse(diffuse->pixels(), material);
    diffuse.reset();
  }
  if (specgloss && is_constant(specgloss->pixels())) {
    fold_specgloss(specgloss->pixels(), material);
    specgloss.reset();
  }
  if (!diffuse && !specgloss) return std::nullopt;
  if (diffuse && specgloss)
    textures_.align({&*diffuse, &*specgloss}, {"metallic", ", or --profile extensions"}, warnings);
  const Converted& images = converted(diffuse, specgloss, material);
  CoreTexts texts;
  for (std::size_t c = 0; c < 3; ++c)
    texts.base_color[c] = images.base_image ? std::string("1") : material.diffuse[c].text;
  texts.base_color[3] = material.diffuse[3].text;
  if (images.base_image)
    texts.base_texture = textures_.text_of(diffuse ? *diffuse : *specgloss, *images.base_image);
  else
    texts.base_texture = {material.diffuse_texture, {}};
  texts.metallic = float_text(images.maps.metallic);
  texts.roughness = float_text(images.maps.roughness);
  if (images.metal_rough_image)
    texts.metal_rough_texture =
        textures_.text_of(specgloss ? *specgloss : *diffuse, *images.metal_rough_image);
  texts.has_metal = images.maps.has_metal;
  texts.residual = images.maps.residual;
  return texts;
}

CoreTexts SpecGlossTextures::exact(const SpecGlossMaterial& material) {
  CoreTexts texts;
  for (std::size_t c = 0; c < 4; ++c) texts.base_color[c] = material.diffuse[c].text;
  if (material.diffuse_texture) {
    (void)textures_.images().info_of(material.diffuse_texture);
    texts.base_texture = {material.diffuse_texture, {}};
  }
  texts.metallic = "0";
  texts.roughness = float_text(roughness_of(material.glossiness.value));
  const std::optional<UsedTexture> specgloss =
      textures_.load(material.specgloss_texture, "specular-glossiness");
  if (!specgloss) return texts;
  texts.specular_texture = {material.specgloss_texture, {}};
  const ImagePixels& pixels = specgloss->pixels();
  if (!pixels.has_alpha()) return texts;
  const std::string key = texture_key(specgloss) + " " + number_text(material.glossiness.value);
  if (!roughness_maps_.contains(key)) {
    const ImagePixels map = roughness_map(pixels, material.glossiness.value);
    if (is_constant(map)) {
      texts.roughness = float_text(first_texel(map)[1]);
      return texts;
    }
    roughness_maps_[key] = textures_.add_data(map, *specgloss, kRoughnessSuffix);
  }
  texts.metal_rough_texture = textures_.text_of(*specgloss, roughness_maps_[key]);
  texts.roughness = "1";
  return texts;
}

}  // namespace remap
