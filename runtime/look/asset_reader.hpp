// This file reads materials of assets as maps and balls.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "assets/document/asset.hpp"
#include "look/material_looks.hpp"

namespace remap {

// An AssetFile is an open asset. All members must outlive its use.
struct AssetFile {
  const ByteSource& bytes;
  const std::string& context;  // for messages
  const AssetResources& resources;
};

// An AssetReader reads materials of an asset as maps. All functions throw kInput for what cannot be read.
class AssetReader {
 public:
  virtual ~AssetReader() = default;
  // Returns the maps of a material as its file describes it, with at most about `side` texels a side.
  virtual ScaledMaps maps(const AssetMaterial& material, int side) = 0;
  // Returns the ball of these maps. `ggx` shows GGX with F0, the model of glTF.
  virtual TexturedBall ball(const AssetMaterial& material, const ShownModel& ggx, ScaledMaps maps) const = 0;
  // Returns what programs show that ignore extensions of glTF, or nothing for a material without these.
  virtual std::optional<TexturedBall> without_extensions(const AssetMaterial&, const ShownModel&, int) {
    return std::nullopt;
  }
  // Returns the normals (render_textured), or an image without values.
  virtual Image normals(const AssetMaterial&, int) { return {}; }
};

std::unique_ptr<AssetReader> gltf_reader(const AssetFile& file);
// Reads the materials of an MTL file, or of the MTL files that an OBJ file names. Materials of the
// specification are shown by unnormalised Blinn (legacy/blinn-phong), materials with Pr and Pm like glTF.
std::unique_ptr<AssetReader> mtl_reader(const AssetFile& file, std::optional<MtlMaker> maker, bool is_obj);

}  // namespace remap
