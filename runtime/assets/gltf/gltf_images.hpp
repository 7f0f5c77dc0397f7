// This file reads the images of a glTF file, from its binary chunk, data URIs or files, and decodes them.
// gltf_new_images.hpp makes new ones.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/gltf/gltf_container.hpp"
#include "assets/maps/texture_bake.hpp"
#include "core/json_spans.hpp"

namespace remap {

class GltfBytes {
 public:
  // All arguments except `open` must outlive this object.
  GltfBytes(const SpannedJson& json, const GltfContainer& container, const ByteSource& source,
            OpenAssetFile open);

  // Returns the bytes of an image, as its file has them. Throws kInput if there is no image with this index,
  // or if its bytes cannot be read.
  std::string of_image(std::size_t index) const;

 private:
  std::string of_uri(const std::string& uri) const;
  std::string of_view(std::size_t index) const;

  const GltfContainer& container_;
  const ByteSource& source_;
  OpenAssetFile open_;
  std::vector<SpanValue> images_, views_, buffers_;
};

// Returns an entry of a list of the file. `name` is for messages. Throws kInput for an index beyond the list.
SpanValue gltf_entry(const std::vector<SpanValue>& list, std::size_t index, const char* name);

// Returns the bytes of a data URI (RFC 2397), whose type may have parameters. Throws kInput.
std::string data_of_uri(std::string_view uri);

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
