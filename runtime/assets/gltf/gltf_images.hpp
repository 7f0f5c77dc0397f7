// The images of a glTF file, found by their textures and decoded. New ones: gltf_new_images.hpp.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/document/image_codec.hpp"
#include "assets/gltf/gltf_bytes.hpp"
#include "assets/maps/texture_bake.hpp"
#include "core/json_spans.hpp"

namespace remap {

// A decoded image, and where it comes from.
struct AssetImage {
  std::size_t texture = 0, image = 0;  // indices
  std::shared_ptr<const ImagePixels> pixels;
  bool is_jpeg = false;
};

// How a material reads a texture.
struct TextureInfo {
  SpanValue value;
  std::size_t texture = 0;
  std::size_t tex_coord = 0;
  TextureTransform transform;
};

class GltfImages {
 public:
  // All arguments must outlive this object.
  GltfImages(const SpannedJson& json, const GltfBytes& bytes, const AssetResources& resources);

  // Throws kInput for an index or a transform that cannot be read.
  TextureInfo info_of(SpanValue texture_info) const;
  // Loads the best image of a texture that can be decoded: the image of an extension, otherwise the texture's
  // own. Throws kInput with the name of the image.
  AssetImage load(const TextureInfo& info);
  // Whether two textures repeat their images alike.
  bool wraps_alike(std::size_t texture, std::size_t other) const;

 private:
  const GltfBytes& bytes_;
  const AssetResources& resources_;  // its codec takes time to load, and many files have no images
  std::vector<SpanValue> textures_, samplers_;
  std::list<AssetImage> recent_;  // the newest first
};

// The images of a texture: those of extensions, the most common first, and its own.
std::vector<std::size_t> images_of_texture(SpanValue texture);

}  // namespace remap
