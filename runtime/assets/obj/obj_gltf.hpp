// A glTF 2.0 file of an OBJ file and the MTL files that it names.
#pragma once

#include <string>
#include <vector>

#include "assets/document/asset.hpp"

namespace remap {

struct GltfOutput {
  bool as_glb = true;         // one file; else .gltf with a buffer beside it
  std::string name = "mesh";  // of the buffer of a .gltf, without its extension
};

// Meshes by tinyobjloader (obj_mesh.hpp), a node for each group or object; materials by legacy_material.hpp,
// those that have Pr or Pm as they are. PNG and JPEG files are embedded in a .glb, and for a .gltf named
// among `resources`, to be copied; what else is there becomes PNG. A material whose map is missing has the
// state kFailed and is there without that map. `pieces` hold the whole file, whatever failed; `text`, its
// JSON. Throws kInput, beginning with `context`, for geometry that cannot be read and a file without
// triangles; kOutput for 4 GiB or more.
AssetConversion gltf_of_obj(const ByteSource& obj, const std::string& context, const AssetOptions& options,
                            const AssetResources& resources, const GltfOutput& output = {});

// The MTL files that an OBJ file names and that are there, and their images. Throws kInput, beginning with
// `context` or the name of an MTL file.
std::vector<AssetResource> obj_resources(const ByteSource& obj, const std::string& context,
                                         const AssetResources& resources);

}  // namespace remap
