// This file finds images of a glTF file by texture and decodes them. gltf_new_images.hpp makes new ones.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <vector>

#include "assets/document/image_codec.hpp"
#include "assets/gltf/gltf_bytes.hpp"
#include "assets/maps/texture_bake.hpp"
#include "core/json_spans.hpp"

namespace remap {

// An AssetImage is a decoded image with its origin.
struct AssetImage {
  std::size_t texture = 0, image = 0;  // indices in the file
  std::shared_ptr<const ImagePixels> pixels;
  bool is_jpeg = false;
};

// A TextureInfo states how a material reads a texture.
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

  // Reads a texture info. Throws kInput for an index or a transform that cannot be read.
  TextureInfo info_of(SpanValue texture_info) const;
  // Loads the first image of a texture that can be decoded. Images of extensions come first, and then the
  // texture's own image. Throws kInput with the name of the image.
  AssetImage load(const TextureInfo& info);
  // Returns true if two textures repeat their images in the same way.
  bool wraps_alike(std::size_t texture, std::size_t other) const;

 private:
  const GltfBytes& bytes_;
  // Its codec is requested only when an image is loaded, because this takes time, and many files have no
  // images.
  const AssetResources& resources_;
  std::vector<SpanValue> textures_, samplers_;
  std::list<AssetImage> recent_;  // the newest first
};

// Returns the images of a texture: first the images of its extensions, the most common extension first, then
// its own.
std::vector<std::size_t> images_of_texture(SpanValue texture);

}  // namespace remap
