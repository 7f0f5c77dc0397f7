// This file finds and decodes a converted material's textures, brings them onto one grid, and replaces them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "assets/gltf/gltf_images.hpp"
#include "assets/gltf/gltf_inputs.hpp"
#include "assets/gltf/gltf_new_images.hpp"
#include "assets/maps/texture_bake.hpp"

namespace remap {

// A UsedTexture is a texture of a material.
struct UsedTexture {
  std::string_view member;  // name of the member in the material or extension: `specularGlossinessTexture`
  Transfer transfer = Transfer::kSrgb;  // curve of its colors
  TextureInfo info;
  AssetImage image;
  std::string bake;  // how its pixels were resampled, or empty

  const ImagePixels& pixels() const { return *image.pixels; }
  // Returns the name in messages, such as `specular glossiness`.
  std::string name() const;
};

// A UsedTextures holds the varying textures of a material, on one grid, in the order of its inputs.
struct UsedTextures {
  std::vector<UsedTexture> textures;

  // Returns null for an input without a texture.
  const UsedTexture* of(GltfInput input) const;
  const ImagePixels* pixels_of(GltfInput input) const;
  // Returns the texture of the first of these inputs that has one. There must be such an input.
  const UsedTexture& first_of(std::span<const GltfInput> inputs) const;
  // Returns a text that identifies the content of the images: their indices, and how they were resampled.
  std::string key() const;
};

// A GridReason states why textures must lie on one grid, for messages.
struct GridReason {
  std::string_view decided;  // parameters that need all textures at once, such as `metallic`
  std::string_view otherwise;
};

// A MaterialTextures loads and adds textures for all materials of a file.
class MaterialTextures {
 public:
  // All arguments must outlive this object.
  MaterialTextures(const AssetOptions& options, const AssetResources& resources, GltfImages& images,
                   GltfNewImages& new_images)
      : options_(options), resources_(resources), images_(images), new_images_(new_images) {}

  // Throws kInput for a texture whose index or transform cannot be read.
  void require_readable(SpanValue texture_info) const {
    if (texture_info) (void)images_.info_of(texture_info);
  }
  // Throws kInput for an image that cannot be read.
  UsedTexture load(SpanValue texture_info, GltfInput input);
  // Loads the textures of the inputs. If they differ in size or place, brings them to one size and one grid,
  // as far as the options allow. Maps of one value become factors of `material`. Throws kInput if this is not
  // possible.
  UsedTextures load(GltfMaterial& material, std::span<const GltfInput> inputs, const GridReason& reason,
                    std::vector<std::string>& warnings);

  // Adds a color image and returns its number. Data is PNG. Color may be JPEG, unless it has alpha or its
  // source, `color`, is not JPEG.
  std::size_t add_color(const ImagePixels& pixels, const UsedTexture& model, const UsedTexture* color,
                        std::string_view suffix);
  std::size_t add_data(const ImagePixels& pixels, const UsedTexture& model, std::string_view suffix);
  // Returns the info of the model with a texture of a new image.
  TextureText text_of(const UsedTexture& model, std::size_t image);

 private:
  void align(std::vector<UsedTexture>& textures, const GridReason& reason,
             std::vector<std::string>& warnings) const;
  void require_one_grid(const UsedTexture& first, const UsedTexture& other, const GridReason& reason) const;
  int png_level() const { return options_.png_level.value_or(kUsualPngLevel); }
  // Brings textures with different transforms onto the grid of one of them.
  void bake(std::vector<UsedTexture>& textures, const GridReason& reason,
            std::vector<std::string>& warnings) const;
  void enlarge(std::vector<UsedTexture>& textures) const;
  void resample(UsedTexture& texture, const TextureGrid& grid) const;

  const AssetOptions& options_;
  const AssetResources& resources_;
  GltfImages& images_;
  GltfNewImages& new_images_;
};

// Multiplies the factors of `material` by the first texel of a texture of its inputs.
void fold_first_texel(const UsedTexture& texture, std::span<const GltfInput> inputs, GltfMaterial& material);

}  // namespace remap
