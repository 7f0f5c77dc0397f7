// This file makes a glTF 2.0 file from an OBJ file and the MTL files that it names.
#pragma once

#include <string>
#include <vector>

#include "assets/document/asset.hpp"

namespace remap {

// Converts meshes by tinyobjloader (obj_mesh.hpp), with a node for each group or object. Converts materials
// by legacy_maps.hpp; Pr and Pm stay unchanged. `buffer_file` is written beside a .gltf;
// without it, the result is one .glb. A .glb embeds PNG and JPEG files. For a .gltf they are listed in
// `resources`, to be copied. Other images become PNG. A material whose map is missing has the state kFailed
// and lacks that map. `pieces` hold the whole file, even after failures; `text` is its JSON. Throws kInput,
// beginning with `context`, for geometry that cannot be read and a file without triangles. Throws kOutput for
// 4 GiB or more.
AssetConversion gltf_of_obj(const ByteSource& obj, const std::string& context, const AssetOptions& options,
                            const AssetResources& resources, const std::string& buffer_file = "");

// Returns the existing MTL files that an OBJ file names, and their images. Throws kInput, beginning with
// `context` or the name of an MTL file.
std::vector<AssetResource> obj_resources(const ByteSource& obj, const std::string& context,
                                         const AssetResources& resources);

}  // namespace remap
