// Input of the warps study: pairs of materials with a known result, and strokes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "warp/space/material.hpp"

namespace remapc {

struct WarpCase {
  std::string name;
  std::size_t width = 0, height = 0;             // size of all maps in texels
  WarpMaterial source, target;                   // row-major
  std::vector<remap::WarpTexel> truth;           // the correct result for each source texel
  std::vector<std::vector<StrokePair>> strokes;  // several sets of strokes in the same regions
};

// Reads one case from each subfolder of the first folder, in the order of their names:
// {source,template,truth}/ {diffuse,specular,alpha}.exr, linear, GGX with Schlick's Fresnel;
// strokes/{source,template}<k>.exr from k = 0, masks of texels above 0.5. Each further folder has the same
// cases with another set of strokes. Throws kInput for files that are missing, cannot be read or differ in
// size, and for texels that are not finite.
std::vector<WarpCase> read_warp_cases(const std::vector<std::filesystem::path>& folders);

}  // namespace remapc
