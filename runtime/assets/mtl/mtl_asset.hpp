// This file handles a whole MTL file: the lines of its materials, and the images that they refer to.
#pragma once

#include <string>
#include <vector>

#include "assets/document/asset.hpp"

namespace remap {

// Adds metallic and roughness (Pr, Pm and their maps, which newer tools read) to each material that lacks
// them, and makes Kd the base color. All other lines stay byte for byte. Ks and Ns stay, too, for older
// programs. UTF-16 stays UTF-16. Images are relative to the folder of the file. Throws kInput, beginning with
// `context`, for a text that cannot be read. Without `resources`, materials whose maps must be read fail.
AssetConversion convert_mtl(const ByteSource& source, const std::string& context,
                            const AssetOptions& options = {}, const AssetResources* resources = nullptr);

// Returns the images that the file uses, each once. If `resources` is not null, paths are where the images
// are found. Throws kInput, beginning with `context`.
std::vector<AssetResource> mtl_resources(const ByteSource& source, const std::string& context,
                                         const AssetResources* resources = nullptr);

}  // namespace remap
