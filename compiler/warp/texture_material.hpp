// This file reads texture sets as materials of a warp.
#pragma once

#include <filesystem>

#include "warp/material.hpp"

namespace remap {

// An AlbedoAlone decides how to read a folder that has neither roughness nor specular.
enum class AlbedoAlone {
  kRefuse,
  kEnrich,  // diffuse or base color with specular 0 and alpha 1 (An et al. 2011, section 4)
};

// Reads the only set of `folder`, which is found by the names of its maps (runtime/sets). The set has
// diffuse, specular (F0 or scale of `model`), and roughness, glossiness or alpha, which become alpha. Or it
// has base color and metallic, which are converted by equation (2). All maps must have the same size. Throws
// kInput for missing and ambiguous maps, and kUsage for a model that the built-in renderer does not have.
WarpMaterial read_texture_material(const std::filesystem::path& folder, const std::string& model,
                                   AlbedoAlone albedo = AlbedoAlone::kRefuse);

}  // namespace remap
