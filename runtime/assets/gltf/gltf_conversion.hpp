// The materials of a glTF file: each is read and converted by the direction that takes it, and then all are
// written into the text.
#pragma once

#include <string>

#include "assets/document/asset.hpp"
#include "assets/gltf/gltf_container.hpp"
#include "core/json_spans.hpp"

namespace remap {

// A glTF file that is read.
struct GltfSource {
  const SpannedJson& json;
  const GltfContainer& container;
  const ByteSource& bytes;
  const std::string& context;
};

struct GltfResult {
  AssetConversion asset;  // without pieces and resources
  BinaryTail tail;
};

// Throws kInput, beginning with the place, for a text that is not glTF 2; kUsage for options that exclude
// each other. Without `resources`, materials with textures fail.
GltfResult convert_materials(const GltfSource& source, const AssetOptions& options,
                             const AssetResources* resources);

}  // namespace remap
