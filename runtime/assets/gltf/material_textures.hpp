// Textures of a material that is converted: found, decoded, brought onto one grid, and replaced by new ones.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "assets/gltf/gltf_images.hpp"
#include "assets/gltf/gltf_new_images.hpp"
#include "assets/maps/texture_bake.hpp"
#include "remap/model.hpp"

namespace remap {

// The endings of the names of new images.
inline constexpr std::string_view kBaseSuffix = "_baseColor", kMetalRoughSuffix = "_metallicRoughness";

// A texture of a material, with its name in messages: `specular-glossiness`.
struct UsedTexture {
  std::string_view name;
  Transfer transfer = Transfer::kSrgb;  // of its colors
  TextureInfo info;
  AssetImage image;
  std::string bake;  // how its pixels were resampled; empty where they were not

  const ImagePixels& pixels() const { return *image.pixels; }
};

// Why textures must lie on one grid, for messages.
struct GridReason {
  std::string_view decided;    // `metallic`: what all of them decide on
  std::string_view otherwise;  // `, or --profile extensions`: what needs no grid; empty for nothing
};

// For all materials of a file.
class MaterialTextures {
 public:
  // All must outlive it.
  MaterialTextures(const AssetOptions& options, const AssetResources& resources, GltfImages& images,
                   GltfNewImages& new_images)
      : options_(options), resources_(resources), images_(images), new_images_(new_images) {}

  const GltfImages& images() const noexcept { return images_; }
  // None without an info. Throws kInput for an image that cannot be read.
  std::optional<UsedTexture> load(SpanValue texture_info, std::string_view name,
                                  Transfer transfer = Transfer::kSrgb);
  // Gives all one size and one grid, as far as the options allow. Throws kInput otherwise.
  void align(const std::vector<UsedTexture*>& textures, const GridReason& reason,
             std::vector<std::string>& warnings) const;

  // Returns the number of the new image. Data is PNG. Color may be JPEG, unless it has alpha or comes from a
  // map of color, `color`, that is none.
  std::size_t add_color(const ImagePixels& pixels, const UsedTexture& model,
                        const std::optional<UsedTexture>& color, std::string_view suffix);
  std::size_t add_data(const ImagePixels& pixels, const UsedTexture& model, std::string_view suffix);
  // The info of the model with a texture of a new image.
  TextureText text_of(const UsedTexture& model, std::size_t image);

 private:
  void require_one_grid(const UsedTexture& first, const UsedTexture& other, const GridReason& reason) const;
  int png_level() const { return options_.png_level.value_or(kUsualPngLevel); }
  // Brings textures with different transforms onto the grid of one of them.
  void bake(const std::vector<UsedTexture*>& textures, const GridReason& reason,
            std::vector<std::string>& warnings) const;
  void enlarge(const std::vector<UsedTexture*>& textures) const;
  void resample(UsedTexture& texture, const TextureGrid& grid) const;

  const AssetOptions& options_;
  const AssetResources& resources_;
  GltfImages& images_;
  GltfNewImages& new_images_;
};

// Tells images apart by their indices and how they were resampled.
std::string texture_key(const std::optional<UsedTexture>& texture);

}  // namespace remap
