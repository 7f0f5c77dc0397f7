// Texture sets as the materials of a warp.
#pragma once

#include <filesystem>

#include "warp/space/material.hpp"

namespace remapc {

struct TextureMaterial {
  WarpMaterial material;  // row by row
  std::size_t width = 0, height = 0;
  bool is_albedo = false;  // of a diffuse map alone

  MapFrame frame() const { return {material.name, width, height}; }
};

// What to make of a folder that has neither roughness nor specular.
enum class AlbedoAlone {
  kRefuse,
  kEnrich,  // diffuse, or base color, with specular 0 and alpha 1 (section 4 of An et al. 2011)
};

// The one set of `folder`, by the names of its maps (runtime/discovery): diffuse, specular (F0 or scale of
// `model`), and roughness, glossiness or alpha, which becomes alpha; or base color and metallic, converted
// by equation (2). Maps are one size. Throws kInput where a map is missing, or two hold the same; kUsage for
// a model that the built-in renderer does not know.
TextureMaterial read_texture_material(const std::filesystem::path& folder, const std::string& model,
                                      AlbedoAlone albedo = AlbedoAlone::kRefuse);

}  // namespace remapc
