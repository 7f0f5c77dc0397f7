// The exact copy of a warp as files: every texel of the source holds what one texel of the template does.
#pragma once

#include <filesystem>
#include <vector>

#include "warp/space/material.hpp"

namespace remapc {

// What the template is, and where its table stands.
struct CopiedTemplate {
  MaterialRef material;
  MapFrame frame;
  std::filesystem::path table;  // of a tabulated one: profiles.exr, profiles.csv or brdfs.txt
};

// Writes to `folder`, all as float32 EXR of the source's size, NaN where a texel takes no part:
//   of parameters      diffuse.exr, specular.exr, alpha.exr
//   of a list          index.exr, and the list beside it (profiles.csv; brdfs.txt with paths of its own)
//   of profiles.exr    profiles.exr
//   of each            template_texel.exr: channels X and Y, the place in the template, from 0 at the top
//                      left, by which further maps can be copied
// `texels`: of copy_exactly(). Returns the files. Throws kOutput.
std::vector<std::filesystem::path> write_copied_set(const std::filesystem::path& folder,
                                                    const std::vector<std::uint32_t>& texels,
                                                    const MapFrame& source, const CopiedTemplate& goal);

}  // namespace remapc
