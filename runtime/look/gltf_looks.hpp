// This file shows the materials of glTF files before and after a conversion.
#pragma once

#include <string>
#include <vector>

#include "assets/document/asset.hpp"
#include "look/material_looks.hpp"

namespace remap {

// A GltfFile is an open glTF file. All members must outlive its use.
struct GltfFile {
  const ByteSource& bytes;
  const std::string& context;  // for messages
  const AssetResources& resources;
};

// Returns the first `most` materials that a conversion changed, as both files describe them, with at most
// about `side` texels a side. The copied look is what programs show that ignore
// KHR_materials_pbrSpecularGlossiness, _specular and _ior; a source without these has none. `before`
// and `after` show GGX with F0, the model of glTF. Throws kInput for a file or image that cannot be read.
std::vector<MaterialLooks> gltf_looks(const GltfFile& source, const GltfFile& result,
                                      const ShownModel& before, const ShownModel& after,
                                      const std::vector<AssetMaterial>& materials, int side,
                                      std::size_t most);

}  // namespace remap
