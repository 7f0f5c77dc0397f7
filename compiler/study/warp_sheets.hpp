// Results of warps side by side, for eyes (An et al. 2011, figures 2, 3 and 7).
#pragma once

#include <string>
#include <vector>

#include "renderer/image.hpp"
#include "study/warps.hpp"

namespace remapc {

struct WarpSheet {
  std::string name;    // of the file, without extension
  std::string legend;  // what its rows and columns are
  Image picture;
};

// Three sheets a set, of a study with pictures: methods and dimensions (figure 2), each also as its distance
// to the truth; points and nodes, magnified (figure 3); sets of strokes (figure 7). Pictures are 256 pixels
// wide, as shaded_map() lights them.
std::vector<WarpSheet> warp_sheets(const WarpsOptions& options, const WarpsResult& result);

}  // namespace remapc
