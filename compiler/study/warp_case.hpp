// What the study of warps looks at: pairs of materials with a known answer, and strokes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "warp/space/material.hpp"

namespace remapc {

struct WarpCase {
  std::string name;
  std::size_t width = 0, height = 0;             // texels, of all maps
  WarpMaterial source, target;                   // row by row
  std::vector<remap::WarpTexel> truth;           // what the source's texels ought to become
  std::vector<std::vector<StrokePair>> strokes;  // several sets of strokes, all of the same regions
};

// `leaf`, `wood`, `rust`: the sets of warp_sets.hpp.
std::vector<std::string> builtin_warp_names();

// Those of `names`, all where it is empty, `size` x `size`, each with `stroke_sets` sets of strokes. Throws
// kUsage for a size outside 32 to 2048, and for no set of strokes or more than 100.
std::vector<WarpCase> builtin_warp_cases(std::size_t size, std::size_t stroke_sets,
                                         const std::vector<std::string>& names = {});

// A case for each subfolder, in the order of names, of the first folder: source, template and truth/
// {diffuse,specular,alpha}.exr, GGX with Schlick's Fresnel, linear; strokes/{source,template}<k>.exr from 0
// on, masks above a half. Each further folder has the same cases and another set of strokes. Throws kInput
// for files that are missing, cannot be read, are not of one size, and for texels that are not finite.
std::vector<WarpCase> read_warp_cases(const std::vector<std::filesystem::path>& folders);

}  // namespace remapc
