// The images of a glTF file: found by their textures, decoded, and new ones added after the last, where and
// as their models are: in the binary chunk, in a URI, in a file. No index changes and no byte moves.
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/gltf_container.hpp"
#include "assets/image_codec.hpp"
#include "assets/json_spans.hpp"
#include "assets/text_edits.hpp"

namespace remap {

// A decoded image, and where it comes from.
struct AssetImage {
  std::size_t texture = 0, image = 0;  // indices
  std::shared_ptr<const ImagePixels> pixels;
};

// How a material reads a texture.
struct TextureInfo {
  SpanValue value;
  std::size_t texture = 0;
  std::size_t tex_coord = 0;
  std::vector<double> transform;  // offset, scale, rotation (KHR_texture_transform)
};

class GltfImages {
 public:
  // All must outlive it.
  GltfImages(const SpannedJson& json, const GltfContainer& container, const ByteSource& source,
             const AssetResources& resources, const std::string& place, TextEdits& edits);

  // Throws kInput for an index or a transform that cannot be read.
  TextureInfo info_of(SpanValue texture_info) const;
  // The best image of a texture that can be decoded: that of an extension, else its own. Throws kInput,
  // naming the image.
  AssetImage load(const TextureInfo& info);
  // Whether two textures repeat their images alike.
  bool wraps_alike(std::size_t texture, std::size_t other) const;

  // Adds an image beside its model. `suffix` goes to names: `_baseColor`. Returns its index.
  std::size_t add_image(const ImagePixels& pixels, std::size_t model, std::string_view suffix);
  // A texture of that image with the sampler of its model. Returns the index, of one that was added before
  // where they agree.
  std::size_t add_texture(std::size_t image, std::size_t model);

  const AssetResources& resources() const noexcept { return resources_; }

  // Writes what holds for all new images, once.
  void finish();
  // What follows the binary chunk, from a multiple of four.
  const std::string& appended() const noexcept { return appended_; }
  std::vector<NewResource>& files() noexcept { return files_; }

 private:
  std::vector<std::size_t> images_of(SpanValue texture) const;
  std::string bytes_of_image(SpanValue image) const;
  std::string bytes_of_view(std::size_t index) const;
  std::string bytes_of_uri(const std::string& uri) const;
  SpanValue entry(const std::vector<SpanValue>& list, std::size_t index, const char* name) const;
  bool is_in_chunk(SpanValue image) const;
  std::uint64_t chunk_size() const;
  std::string place_of_new(const std::string& png, SpanValue model, std::string_view suffix);
  std::string free_uri(const std::string& model, std::string_view suffix);

  SpanValue root_;
  const GltfContainer& container_;
  const ByteSource& source_;
  const AssetResources& resources_;
  const std::string& place_;
  TextEdits& edits_;
  std::vector<SpanValue> textures_, images_, views_, buffers_, samplers_;
  std::vector<std::string> uris_;  // of files, which new ones must not take
  std::list<std::pair<std::size_t, std::shared_ptr<const ImagePixels>>> recent_;  // the newest first
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> new_textures_;       // by image and sampler
  std::size_t image_count_ = 0, texture_count_ = 0, view_count_ = 0;
  std::string appended_;
  std::vector<NewResource> files_;
};

}  // namespace remap
