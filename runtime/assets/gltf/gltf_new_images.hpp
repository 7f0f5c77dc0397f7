// This file adds new images and textures to a glTF file. A new image is stored like the image that it is made
// from: in the binary chunk, in a URI, or in a file. New entries are appended, or replace entries that are no
// longer used. No index changes, and no other bytes move.
// The file also finds what only converted materials used, and the end of the bytes that are still in use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/document/asset_uri.hpp"
#include "assets/document/text_edits.hpp"
#include "assets/gltf/gltf_container.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "core/json_spans.hpp"

namespace remap {

struct GltfSpares {
  std::vector<std::size_t> textures, images, views;  // sorted indices; the views are in the binary chunk
  std::optional<std::uint64_t> chunk_end;            // end of the used bytes; if unset, nothing is cut off
};

// Finds the textures, images and views that nothing uses after the edits. If the file uses extensions that
// are unknown, or that name images themselves, it finds nothing and adds a warning.
GltfSpares find_spares(const SpannedJson& json, const GltfContainer& container,
                       const std::vector<MaterialEdit>& edits, std::vector<std::string>& warnings);

class GltfNewImages {
 public:
  // All arguments must outlive this object.
  GltfNewImages(const SpannedJson& json, const GltfContainer& container, const AssetResources& resources,
                const std::string& context);

  // Adds an image next to its model, an image of the file. `suffix` is part of its name: `_baseColor`.
  // The image is PNG if `jpeg_quality` is missing. Returns the number of the new image, or the number of an
  // earlier new image with equal bytes.
  std::size_t add_image(const ImagePixels& pixels, std::size_t model, std::string_view suffix,
                        std::optional<int> jpeg_quality, int png_level);
  // Adds a texture of a new image. It has the sampler of `model`, a texture of the file. If an equal texture
  // was added before, returns its number, otherwise the number of the new texture.
  std::size_t add_texture(std::size_t image, std::size_t model);

  // Writes all new images. Call this once, at the end, because `spares` is complete only then.
  void write(const GltfSpares& spares, TextEdits& edits);
  // Returns the texture info of a new texture. Call it after write().
  std::string info_text(const TextureText& texture) const;
  // Returns the new end of the binary chunk. Call it after write().
  const BinaryTail& tail() const noexcept { return tail_; }
  std::vector<NewResource>& files() noexcept { return files_; }
  // Returns values of texture extensions that write() removed.
  const std::vector<SpanValue>& removed_extensions() const noexcept { return removed_extensions_; }

 private:
  struct NewImage {
    std::string bytes;
    std::string_view type;  // such as image/png
    std::size_t model = 0;
    std::string suffix;
  };
  struct NewTexture {
    std::size_t image = 0, model = 0;
    std::size_t place = 0;  // set by write()
  };
  // These are the members of an image that state its place and its type.
  using Location = std::vector<std::pair<std::string_view, std::string>>;

  bool is_in_chunk(SpanValue image) const;
  std::string free_uri(const std::string& model, const NewImage& image);
  Location location_of(const NewImage& image, SpanValue own, TextEdits& edits);
  std::size_t add_view(const std::string& bytes, SpanValue own, TextEdits& edits);
  void write_image(const NewImage& image, std::size_t number, TextEdits& edits);
  void write_texture(NewTexture& texture, TextEdits& edits);
  void drop_formats(SpanValue texture, TextEdits& edits);
  void empty_spares(TextEdits& edits);
  void set_location(SpanValue image, const Location& location, TextEdits& edits);
  Location cheapest_location() const;
  SpanValue root_;
  const GltfContainer& container_;
  const AssetResources& resources_;
  const std::string& context_;
  std::vector<SpanValue> textures_, images_, views_, buffers_;
  std::vector<NewImage> new_images_;
  std::vector<NewTexture> new_textures_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known_textures_;  // keyed by image and sampler
  GltfSpares spares_;                                                          // places that are free
  std::set<std::size_t> unused_images_;  // spare images, also those that were used again
  std::vector<std::size_t> image_places_;
  std::vector<Location> locations_;
  std::size_t image_count_ = 0, texture_count_ = 0, view_count_ = 0;
  std::uint64_t chunk_start_ = 0;  // start of the appended bytes
  BinaryTail tail_;
  std::vector<NewResource> files_;
  std::vector<SpanValue> removed_extensions_;
  NewImageNames names_;  // names of files next to the images of the asset
};

}  // namespace remap
