// Folders whose texels are entries of a table: measured BRDFs, or scattering profiles.
#pragma once

#include <filesystem>
#include <vector>

#include "warp/space/material.hpp"

namespace remapc {

// A folder holds one of
//   profiles.exr                a profile a texel: a channel `R@<radius>`, `G@<radius>`, `B@<radius>` for
//   each
//                               radius, or `Y@<radius>` where the channels of light scatter alike
//   profiles.csv and a map      columns named as those channels, a row a profile, the first is entry 0
//   brdfs.txt and a map         a file of a measured BRDF in a line, relative to the folder, in the format of
//                               the MERL database (Matusik et al. 2003); the first is entry 0
// The map is index.exr, .png or .tif, one channel: the number of the entry of each texel. What is no number
// of an entry takes no part. Radii are in one unit, whichever, in source and template.
struct TabulatedSet {
  TabulatedMaterial material;
  std::size_t width = 0, height = 0;
  std::filesystem::path table;  // profiles.exr, profiles.csv or brdfs.txt

  MapFrame frame() const { return {material.name, width, height}; }
};

bool is_tabulated_folder(const std::filesystem::path& folder);

// Throws kInput for a folder that is none, a file that cannot be read, columns or channels of other names,
// radii that are not the same for all channels, values that are negative or not finite.
TabulatedSet read_tabulated_set(const std::filesystem::path& folder);

// Reflectance of the MERL database at the directions of half_vector_quadrature(), channel by channel. Cells
// that were not measured are 0. Throws kInput.
std::vector<float> read_merl(const std::filesystem::path& file);

}  // namespace remapc
