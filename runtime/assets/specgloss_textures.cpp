#include "assets/specgloss_textures.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/errors.hpp"

namespace remap {
namespace {

constexpr std::string_view kBaseSuffix = "_baseColor", kMetalRoughSuffix = "_metallicRoughness",
                           kRoughnessSuffix = "_roughness";

// A factor of a map that has one value everywhere.
void multiply(FactorText& factor, float value) {
  if (value == 1.0f) return;
  factor.value *= static_cast<double>(value);
  factor.text = float_text(static_cast<float>(factor.value));
}

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

std::string size_text(const ImagePixels& pixels) {
  return std::to_string(pixels.width) + " x " + std::to_string(pixels.height);
}

// Tells pairs of images with their factors apart. Alpha is copied, not converted.
std::string key_of(std::size_t diffuse, std::size_t specgloss, const SpecGlossMaterial& material) {
  std::string key = std::to_string(diffuse) + " " + std::to_string(specgloss);
  for (std::size_t c = 0; c < 3; ++c)
    key += " " + number_text(material.diffuse[c].value) + " " + number_text(material.specular[c].value);
  return key + " " + number_text(material.glossiness.value);
}

}  // namespace

std::optional<SpecGlossTextures::Used> SpecGlossTextures::load(SpanValue texture_info) {
  if (!texture_info) return std::nullopt;
  Used used;
  used.info = images_.info_of(texture_info);
  used.image = images_.load(used.info);
  return used;
}

void SpecGlossTextures::require_one_grid(const Used& diffuse, const Used& specgloss,
                                         std::vector<std::string>& warnings) const {
  if (diffuse.info.tex_coord != specgloss.info.tex_coord)
    throw input_error("its diffuse texture lies on TEXCOORD_" + std::to_string(diffuse.info.tex_coord) +
                      ", its specular-glossiness texture on TEXCOORD_" +
                      std::to_string(specgloss.info.tex_coord) +
                      ", and both decide on metallic (bake them onto one, or use --profile extensions)");
  if (diffuse.info.transform != specgloss.info.transform)
    throw input_error(
        "its diffuse and specular-glossiness textures have different KHR_texture_transform, and both decide "
        "on metallic (bake them onto one, or use --profile extensions)");
  const ImagePixels &a = *diffuse.image.pixels, &b = *specgloss.image.pixels;
  if (!enlarges_ && (a.width != b.width || a.height != b.height))
    throw input_error("its diffuse image has " + size_text(a) + " texels, its specular-glossiness image " +
                      size_text(b) + " (use --resample, or --profile extensions)");
  if (!images_.wraps_alike(diffuse.info.texture, specgloss.info.texture))
    warnings.emplace_back(
        "its textures are repeated differently; each result is as the map that it follows, so they may "
        "differ outside of 0 to 1");
}

void SpecGlossTextures::enlarge(Used& diffuse, Used& specgloss) const {
  const std::size_t width = std::max(diffuse.image.pixels->width, specgloss.image.pixels->width),
                    height = std::max(diffuse.image.pixels->height, specgloss.image.pixels->height);
  for (Used* used : {&diffuse, &specgloss}) {
    const ImagePixels& pixels = *used->image.pixels;
    if (pixels.width != width || pixels.height != height)
      used->image.pixels =
          std::make_shared<const ImagePixels>(images_.resources().enlarged(pixels, width, height));
  }
}

const SpecGlossTextures::Converted& SpecGlossTextures::converted(const std::optional<Used>& diffuse,
                                                                 const std::optional<Used>& specgloss,
                                                                 const SpecGlossMaterial& material) {
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  const std::string key =
      key_of(diffuse ? diffuse->image.image : kNone, specgloss ? specgloss->image.image : kNone, material);
  const auto [place, is_new] = converted_.try_emplace(key);
  Converted& result = place->second;
  if (!is_new) return result;
  const MetalRoughMaps maps =
      projected({diffuse ? diffuse->image.pixels.get() : nullptr,
                 specgloss ? specgloss->image.pixels.get() : nullptr, material.factors()},
                prior_, set_);
  const std::size_t color_model = diffuse ? diffuse->image.image : specgloss->image.image,
                    data_model = specgloss ? specgloss->image.image : diffuse->image.image;
  if (maps.base_color) result.base_image = images_.add_image(*maps.base_color, color_model, kBaseSuffix);
  if (maps.metal_rough)
    result.metal_rough_image = images_.add_image(*maps.metal_rough, data_model, kMetalRoughSuffix);
  result.metallic = maps.metallic;
  result.roughness = maps.roughness;
  result.has_metal = maps.has_metal;
  result.residual = maps.residual;
  return result;
}

// The texture info of the model, with the index of another texture.
std::string SpecGlossTextures::new_info(const Used& model, std::size_t image) {
  const std::size_t texture = images_.add_texture(image, model.info.texture);
  const SpanValue index = model.info.value["index"];
  std::string text(model.info.value.raw());
  const std::size_t begin = model.info.value.span().begin;
  text.replace(index.span().begin - begin, index.span().end - index.span().begin, std::to_string(texture));
  return text;
}

std::optional<CoreTexts> SpecGlossTextures::core(SpecGlossMaterial& material,
                                                 std::vector<std::string>& warnings) {
  std::optional<Used> diffuse = load(material.diffuse_texture), specgloss = load(material.specgloss_texture);
  if (diffuse && is_constant(*diffuse->image.pixels)) {
    fold_diffuse(*diffuse->image.pixels, material);
    diffuse.reset();
  }
  if (specgloss && is_constant(*specgloss->image.pixels)) {
    fold_specgloss(*specgloss->image.pixels, material);
    specgloss.reset();
  }
  if (!diffuse && !specgloss) return std::nullopt;
  if (diffuse && specgloss) {
    require_one_grid(*diffuse, *specgloss, warnings);
    enlarge(*diffuse, *specgloss);
  }
  const Converted& images = converted(diffuse, specgloss, material);
  CoreTexts texts;
  for (std::size_t c = 0; c < 3; ++c)
    texts.base_color[c] = images.base_image ? std::string("1") : material.diffuse[c].text;
  texts.base_color[3] = material.diffuse[3].text;
  texts.base_texture = images.base_image ? new_info(diffuse ? *diffuse : *specgloss, *images.base_image)
                                         : std::string(material.diffuse_texture.raw());
  texts.metallic = float_text(images.metallic);
  texts.roughness = float_text(images.roughness);
  if (images.metal_rough_image)
    texts.metal_rough_texture = new_info(specgloss ? *specgloss : *diffuse, *images.metal_rough_image);
  texts.has_metal = images.has_metal;
  texts.residual = images.residual;
  return texts;
}

CoreTexts SpecGlossTextures::exact(const SpecGlossMaterial& material) {
  CoreTexts texts;
  for (std::size_t c = 0; c < 4; ++c) texts.base_color[c] = material.diffuse[c].text;
  if (material.diffuse_texture) {
    (void)images_.info_of(material.diffuse_texture);
    texts.base_texture = std::string(material.diffuse_texture.raw());
  }
  texts.metallic = "0";
  texts.roughness = float_text(roughness_of(material.glossiness.value));
  const std::optional<Used> specgloss = load(material.specgloss_texture);
  if (!specgloss) return texts;
  texts.specular_texture = std::string(material.specgloss_texture.raw());
  const ImagePixels& pixels = *specgloss->image.pixels;
  if (!pixels.has_alpha()) return texts;
  const std::string key =
      std::to_string(specgloss->image.image) + " " + number_text(material.glossiness.value);
  if (!roughness_maps_.contains(key)) {
    const ImagePixels map = roughness_map(pixels, material.glossiness.value);
    if (is_constant(map)) {
      texts.roughness = float_text(first_texel(map)[1]);
      return texts;
    }
    roughness_maps_[key] = images_.add_image(map, specgloss->image.image, kRoughnessSuffix);
  }
  texts.metal_rough_texture = new_info(*specgloss, roughness_maps_[key]);
  texts.roughness = "1";
  return texts;
}

}  // namespace remap
