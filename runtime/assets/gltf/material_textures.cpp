#include "assets/gltf/material_textures.hpp"

#include <algorithm>
#include <memory>

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

std::optional<UsedTexture> MaterialTextures::load(SpanValue texture_info, std::string_view name,
                                                  Transfer transfer) {
  if (!texture_info) return std::nullopt;
  UsedTexture used;
  used.name = name;
  used.transfer = transfer;
  used.info = images_.info_of(texture_info);
  used.image = images_.load(used.info);
  return used;
}

void MaterialTextures::require_one_grid(const UsedTexture& first, const UsedTexture& other,
                                        const GridReason& reason) const {
  const std::string decided = " decide on " + std::string(reason.decided),
                    otherwise = std::string(reason.otherwise) + ")";
  const std::string own_name(first.name), other_name(other.name);
  if (first.info.tex_coord != other.info.tex_coord)
    throw input_error("its " + own_name + " texture lies on TEXCOORD_" +
                      std::to_string(first.info.tex_coord) + ", its " + other_name + " texture on TEXCOORD_" +
                      std::to_string(other.info.tex_coord) + ", and both" + decided +
                      " (bake them onto one in a modeller" + otherwise);
  if (first.info.transform != other.info.transform && !options_.bakes)
    throw input_error("its " + own_name + " and " + other_name +
                      " textures have different KHR_texture_transform, and both" + decided + " (use --bake" +
                      otherwise);
  if (!options_.enlarges && first.info.transform == other.info.transform &&
      !is_same_size(first.pixels(), other.pixels()))
    throw input_error("its " + own_name + " image has " + size_text(first.pixels()) + " texels, its " +
                      other_name + " image " + size_text(other.pixels()) + " (use --resample" + otherwise);
}

void MaterialTextures::align(const std::vector<UsedTexture*>& textures, const GridReason& reason,
                             std::vector<std::string>& warnings) const {
  if (textures.size() < 2) return;
  UsedTexture& first = *textures.front();
  bool wraps_alike = true;
  for (UsedTexture* const texture : textures) {
    require_one_grid(first, *texture, reason);
    wraps_alike = wraps_alike && images_.wraps_alike(first.info.texture, texture->info.texture);
  }
  if (std::ranges::any_of(textures, [&](const UsedTexture* texture) {
        return texture->info.transform != first.info.transform;
      }))
    bake(textures, reason, warnings);
  enlarge(textures);
  if (!wraps_alike)
    warnings.emplace_back(
        "its textures are repeated differently; each result is as the map that it follows, so they may "
        "differ outside of 0 to 1");
}

void MaterialTextures::bake(const std::vector<UsedTexture*>& textures, const GridReason& reason,
                            std::vector<std::string>& warnings) const {
  std::vector<PlacedTexture> placed;
  for (const UsedTexture* const texture : textures)
    placed.push_back({texture->pixels().width, texture->pixels().height, texture->info.transform});
  const std::optional<CommonGrid> common = common_grid(placed);
  if (!common)
    throw input_error("its " + std::string(textures.front()->name) + " and " +
                      std::string(textures.back()->name) +
                      " textures repeat differently, and no image can hold both (bake them onto one in a "
                      "modeller" +
                      std::string(reason.otherwise) + ")");
  const UsedTexture& model = *textures[common->of];
  const TextureInfo place = model.info;
  for (UsedTexture* const texture : textures) {
    const ImagePixels& own = texture->pixels();
    texture->bake = bake_key(texture->info.transform, place.transform);
    if (texture->info.transform != place.transform || own.width != common->grid.width ||
        own.height != common->grid.height)
      resample(*texture, common->grid);
    texture->info.value = place.value;
    texture->info.transform = place.transform;
    if (texture != &model && !common->repeats)
      warnings.push_back("its " + std::string(texture->name) + " texture is drawn onto the image of its " +
                         std::string(model.name) +
                         " texture, which is right where texture coordinates are within 0 to 1");
  }
}

// All get the largest size.
void MaterialTextures::enlarge(const std::vector<UsedTexture*>& textures) const {
  std::size_t width = 0, height = 0;
  for (const UsedTexture* const texture : textures) {
    width = std::max(width, texture->pixels().width);
    height = std::max(height, texture->pixels().height);
  }
  for (UsedTexture* const texture : textures) {
    if (texture->pixels().width == width && texture->pixels().height == height) continue;
    if (texture->transfer == Transfer::kSrgb)
      texture->image.pixels =
          std::make_shared<const ImagePixels>(resources_.enlarged(texture->pixels(), width, height));
    else
      resample(*texture, {width, height, texture->info.transform});
  }
}

void MaterialTextures::resample(UsedTexture& texture, const TextureGrid& grid) const {
  texture.image.pixels = std::make_shared<const ImagePixels>(
      baked(texture.pixels(), texture.transfer, texture.info.transform, grid));
}

std::size_t MaterialTextures::add_color(const ImagePixels& pixels, const UsedTexture& model,
                                        const std::optional<UsedTexture>& color, std::string_view suffix) {
  const bool is_exact =
      pixels.has_alpha() || pixels.type != PixelType::kUint8 || (color && !color->image.is_jpeg);
  return new_images_.add_image(pixels, model.image.image, suffix,
                               {is_exact ? std::nullopt : options_.jpeg_quality, png_level()});
}

std::size_t MaterialTextures::add_data(const ImagePixels& pixels, const UsedTexture& model,
                                       std::string_view suffix) {
  return new_images_.add_image(pixels, model.image.image, suffix, {std::nullopt, png_level()});
}

TextureText MaterialTextures::text_of(const UsedTexture& model, std::size_t image) {
  return {model.info.value, new_images_.add_texture(image, model.info.texture)};
}

std::string texture_key(const std::optional<UsedTexture>& texture) {
  return texture ? std::to_string(texture->image.image) + texture->bake : "-";
}

}  // namespace remap
