// This file converts the materials of a glTF file. The first suitable direction reads and converts each
// material. Then all materials are written into the text.
#pragma once

#include <string>

#include "assets/document/asset.hpp"
#include "assets/gltf/gltf_container.hpp"
#include "core/json_spans.hpp"

namespace remap {

// A GltfSource is a glTF file that has been read.
struct GltfSource {
  const SpannedJson& json;
  const GltfContainer& container;
  const ByteSource& bytes;
  const std::string& context;
};

// Throws kInput, beginning with the place, for a text that is not glTF 2, and kUsage for options that exclude
// each other. Without `resources`, materials with textures fail. The caller fills in the resources.
AssetConversion convert_materials(const GltfSource& source, const AssetOptions& options,
                                  const AssetResources* resources);

}  // namespace remap
