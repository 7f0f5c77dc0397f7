// The bytes that a glTF file names: of images and views, in the binary chunk, in data URIs, in files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/gltf/gltf_container.hpp"
#include "core/json_spans.hpp"

namespace remap {

class GltfBytes {
 public:
  // All must outlive it.
  GltfBytes(const SpannedJson& json, const GltfContainer& container, const ByteSource& source,
            const AssetFiles& files);

  // The bytes of an image as its file has them. Throws kInput for an index without an image, and for one
  // whose bytes cannot be read.
  std::string of_image(std::size_t index) const;

 private:
  std::string of_uri(const std::string& uri) const;
  std::string of_view(std::size_t index) const;

  const GltfContainer& container_;
  const ByteSource& source_;
  const AssetFiles& files_;
  std::vector<SpanValue> images_, views_, buffers_;
};

// The entry of a list of the file. `name`: of one, in a message. Throws kInput for an index beyond it.
SpanValue gltf_entry(const std::vector<SpanValue>& list, std::size_t index, const char* name);

// The bytes of a data URI (RFC 2397); its type may have parameters. Throws kInput.
std::string data_of_uri(std::string_view uri);

}  // namespace remap
