// This file handles a whole glTF file: its container, its materials, and the files that it refers to.
#pragma once

#include <string>
#include <vector>

#include "assets/document/asset.hpp"

namespace remap {

// Returns the files that an asset refers to. Throws like convert_gltf().
std::vector<AssetResource> gltf_resources(const ByteSource& source, const std::string& context);

// Reads and converts a file of either form (.gltf or .glb). Throws kInput, beginning with `context`, for a
// container or a text that cannot be read, and for views that lie outside of their buffers. Throws kOutput
// like with_json(). If `resources` is null, materials with textures fail.
AssetConversion convert_gltf(const ByteSource& source, const std::string& context,
                             const AssetOptions& options = {}, const AssetResources* resources = nullptr);

}  // namespace remap
