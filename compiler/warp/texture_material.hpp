// Texture sets as the materials of a warp.
#pragma once

#include <filesystem>

#include "warp/material.hpp"

namespace remapc {

struct TextureMaterial {
  WarpMaterial material;  // row by row
  std::size_t width = 0, height = 0;
};

// The one set of `folder`, by the names of its maps (runtime/sets): diffuse, specular (F0 or scale of
// `model`), and roughness, glossiness or alpha, which becomes alpha; or base colour and metallic, converted
// by equation (2). Maps are one size. Throws kInput where a map is missing, or two hold the same; kUsage for
// a model that the built-in renderer does not know.
TextureMaterial read_texture_material(const std::filesystem::path& folder, const std::string& model);

}  // namespace remapc
