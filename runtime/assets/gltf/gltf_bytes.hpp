// This file reads bytes that a glTF file refers to: images and views, in the binary chunk, data URIs or
// files.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/gltf/gltf_container.hpp"
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

}  // namespace remap
