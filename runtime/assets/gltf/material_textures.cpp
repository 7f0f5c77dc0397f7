#include "assets/gltf/material_textures.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <utility>

#include "assets/maps/map_pixels.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

bool is_same_size(const ImagePixels& a, const ImagePixels& b) {
  return a.width == b.width && a.height == b.height;
}

std::string bake_key(const TextureTransform& from, const TextureTransform& to) {
  std::string key;
  for (const TextureTransform& transform : {from, to})
    for (const double number : {transform.offset[0], transform.offset[1], transform.scale[0],
                                transform.scale[1], transform.rotation})
      key += "," + number_text(number);
  return key;
}

}  // namespace

std::string UsedTexture::name() const {
  std::string words;
  for (const char letter : member.substr(0, member.rfind("Texture"))) {
    const bool is_capital = letter >= 'A' && letter <= 'Z';
    if (is_capital) words += ' ';
    words += is_capital ? static_cast<char>(letter - 'A' + 'a') : letter;
  }
  return words;
}

const UsedTexture* UsedTextures::of(GltfInput input) const {
  const auto found = std::ranges::find(textures, info_of(input).texture, &UsedTexture::member);
  return found == textures.end() ? nullptr : &*found;
}

const ImagePixels* UsedTextures::pixels_of(GltfInput input) const {
  const UsedTexture* const texture = of(input);
  return texture != nullptr ? &texture->pixels() : nullptr;
}

const UsedTexture& UsedTextures::first_of(std::span<const GltfInput> inputs) const {
  return *of(*std::ranges::find_if(inputs, [&](GltfInput input) { return of(input) != nullptr; }));
}

std::string UsedTextures::key() const {
  std::string key;
  for (const UsedTexture& texture : textures)
    key += " " + std::string(texture.member) + " " + std::to_string(texture.image.image) + texture.bake;
  return key;
}

void fold_first_texel(const UsedTexture& texture, std::span<const GltfInput> inputs, GltfMaterial& material) {
  const auto multiply = [](FactorText& factor, float value) {
    if (value == 1.0f) return;
    factor.value *= static_cast<double>(value);
    factor.text = float_text(static_cast<float>(factor.value));
  };
  const std::array<float, 4> texel = first_texel(texture.pixels());
  for (const GltfInput input : inputs) {
    const GltfInputInfo& info = info_of(input);
    if (info.texture != texture.member) continue;
    std::array<FactorText, 4>& factor = material[input].factor;
    if (info.count == 1) multiply(factor[0], texel[info.channel]);
    for (std::size_t c = 0; info.count > 1 && c < info.count; ++c)
      multiply(factor[c], c < 3 ? linear_of_srgb(texel[c]) : texel[c]);
  }
}

UsedTexture MaterialTextures::load(SpanValue texture_info, GltfInput input) {
  UsedTexture used;
  used.member = info_of(input).texture;
  used.transfer = info_of(input).count > 1 ? Transfer::kSrgb : Transfer::kLinear;
  used.info = images_.info_of(texture_info);
  used.image = images_.load(used.info);
  return used;
}

UsedTextures MaterialTextures::load(GltfMaterial& material, std::span<const GltfInput> inputs,
                                    const GridReason& reason, std::vector<std::string>& warnings) {
  UsedTextures used;
  std::set<std::string_view> known;
  for (const GltfInput input : inputs) {
    const SpanValue info = material[input].texture;
    if (!info || !known.insert(info_of(input).texture).second) continue;
    UsedTexture texture = load(info, input);
    if (!is_constant(texture.pixels())) {
      used.textures.push_back(std::move(texture));
      continue;
    }
    fold_first_texel(texture, inputs, material);
    for (const GltfInput other : inputs)
      if (info_of(other).texture == texture.member) material[other].texture = SpanValue();
  }
  align(used.textures, reason, warnings);
  return used;
}

void MaterialTextures::require_one_grid(const UsedTexture& first, const UsedTexture& other,
                                        const GridReason& reason) const {
  const std::string decided = " decide on " + std::string(reason.decided),
                    otherwise = std::string(reason.otherwise) + ")";
  const std::string own_name = first.name(), other_name = other.name();
  if (first.info.tex_coord != other.info.tex_coord)
    throw input_error("its " + own_name + " texture lies on TEXCOORD_" +
                      std::to_string(first.info.tex_coord) + ", its " + other_name + " texture on TEXCOORD_" +
                      std::to_string(other.info.tex_coord) + ", and both" + decided +
                      " (bake both with one set of UVs, for example in Blender" + otherwise);
  if (first.info.transform != other.info.transform && !options_.resamples)
    throw input_error("its " + own_name + " and " + other_name +
                      " textures have different KHR_texture_transform, and both" + decided +
                      " (use --resample" + otherwise);
  if (!options_.resamples && first.info.transform == other.info.transform &&
      !is_same_size(first.pixels(), other.pixels()))
    throw input_error("its " + own_name + " image has " + size_text(first.pixels()) + " texels, its " +
                      other_name + " image " + size_text(other.pixels()) + " (use --resample" + otherwise);
}

void MaterialTextures::align(std::vector<UsedTexture>& textures, const GridReason& reason,
                             std::vector<std::string>& warnings) const {
  if (textures.size() < 2) return;
  const UsedTexture& first = textures.front();
  bool wraps_alike = true;
  for (const UsedTexture& texture : textures) {
    require_one_grid(first, texture, reason);
    wraps_alike = wraps_alike && images_.wraps_alike(first.info.texture, texture.info.texture);
  }
  if (std::ranges::any_of(textures, [&](const UsedTexture& texture) {
        return texture.info.transform != first.info.transform;
      }))
    bake(textures, reason, warnings);
  enlarge(textures);
  if (!wraps_alike)
    warnings.emplace_back(
        "its textures have different wrap modes: the result may be wrong where UVs are outside 0 to 1");
}

void MaterialTextures::bake(std::vector<UsedTexture>& textures, const GridReason& reason,
                            std::vector<std::string>& warnings) const {
  std::vector<TextureGrid> placed;
  for (const UsedTexture& texture : textures)
    placed.push_back({texture.pixels().width, texture.pixels().height, texture.info.transform});
  const std::optional<CommonGrid> common = common_grid(placed);
  if (!common)
    throw input_error("its " + textures.front().name() + " and " + textures.back().name() +
                      " textures repeat differently, and no image can hold both (bake both with one set of "
                      "UVs, for example in Blender" +
                      std::string(reason.otherwise) + ")");
  const UsedTexture& model = textures[common->of];
  const TextureInfo place = model.info;
  for (UsedTexture& texture : textures) {
    const ImagePixels& own = texture.pixels();
    texture.bake = bake_key(texture.info.transform, place.transform);
    if (texture.info.transform != place.transform || own.width != common->grid.width ||
        own.height != common->grid.height)
      resample(texture, common->grid);
    texture.info.value = place.value;
    texture.info.transform = place.transform;
    if (&texture != &model && !common->repeats)
      warnings.push_back("its " + texture.name() + " texture is drawn onto the image of its " + model.name() +
                         " texture, which is correct if texture coordinates are within 0 to 1");
  }
}

// Enlarges all textures to the largest size.
void MaterialTextures::enlarge(std::vector<UsedTexture>& textures) const {
  std::size_t width = 0, height = 0;
  for (const UsedTexture& texture : textures) {
    width = std::max(width, texture.pixels().width);
    height = std::max(height, texture.pixels().height);
  }
  for (UsedTexture& texture : textures) {
    if (texture.pixels().width == width && texture.pixels().height == height) continue;
    if (texture.transfer == Transfer::kSrgb)
      texture.image.pixels =
          std::make_shared<const ImagePixels>(resources_.enlarged(texture.pixels(), width, height));
    else
      resample(texture, {width, height, texture.info.transform});
  }
}

void MaterialTextures::resample(UsedTexture& texture, const TextureGrid& grid) const {
  texture.image.pixels = std::make_shared<const ImagePixels>(
      baked(texture.pixels(), texture.transfer, texture.info.transform, grid));
}

std::size_t MaterialTextures::add_color(const ImagePixels& pixels, const UsedTexture& model,
                                        const UsedTexture* color, std::string_view suffix) {
  const bool is_exact =
      pixels.has_alpha() || pixels.type != PixelType::kUint8 || (color != nullptr && !color->image.is_jpeg);
  return new_images_.add_image(pixels, model.image.image, suffix,
                               is_exact ? std::nullopt : options_.jpeg_quality, png_level());
}

std::size_t MaterialTextures::add_data(const ImagePixels& pixels, const UsedTexture& model,
                                       std::string_view suffix) {
  return new_images_.add_image(pixels, model.image.image, suffix, std::nullopt, png_level());
}

TextureText MaterialTextures::text_of(const UsedTexture& model, std::size_t image) {
  return {model.info.value, new_images_.add_texture(image, model.info.texture)};
}

}  // namespace remap
