// Contact sheets of the warps study (An et al. 2011, figures 2, 3 and 7).
#pragma once

#include <string>
#include <vector>

#include "renderer/image.hpp"
#include "study/warps.hpp"

namespace remapc {

struct WarpSheet {
  std::string name;    // file name without extension
  std::string legend;  // describes the rows and columns
  Image picture;
};

// Draws three sheets for each set of a study with pictures: methods and dimensions with their distances to
// the truth (figure 2); points and nodes, magnified (figure 3); sets of strokes (figure 7). shaded_map()
// shades the pictures, which are 256 pixels wide.
std::vector<WarpSheet> warp_sheets(const WarpsOptions& options, const WarpsResult& result);

}  // namespace remapc
