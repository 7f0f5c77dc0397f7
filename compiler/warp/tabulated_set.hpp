// This file reads folders whose texels are entries of a table: measured BRDFs or scattering profiles.
#pragma once

#include <filesystem>
#include <vector>

#include "warp/material.hpp"

namespace remap {

bool is_tabulated_folder(const std::filesystem::path& folder);

// Reads a folder that contains one of
//   profiles.exr                one profile per texel: channels `R@<radius>`, `G@<radius>`, `B@<radius>` for
//                               each radius, or `Y@<radius>` if the profile is grey
//   profiles.csv and a map      columns with the same names, one row per profile; the first is entry 0
//   brdfs.txt and a map         one file of a measured BRDF per line, relative to the folder, in the format
//                               of the MERL database (Matusik et al. 2003); the first is entry 0
// The map is index.exr, .png or .tif with one channel: the number of each texel's entry. Texels with another
// value are skipped. Radii of source and template must have the same unit.
// Throws kInput for a folder without a table, a file that cannot be read, and unknown columns
// or channels. Also throws it for radii that differ between channels, and negative or infinite values.
TabulatedMaterial read_tabulated_set(const std::filesystem::path& folder);

}  // namespace remap
