// This file reports a warp in pictures. They show both materials, their strokes and appearance spaces, and
// the result (An et al. 2011, figure 1).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "look/image.hpp"
#include "warp/warp.hpp"

namespace remap {

// A WarpReport holds texts, and pictures in display values. The longer side of a map, and the width of a
// space, is 512 pixels.
struct WarpReport {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  // name and value
  std::vector<std::string> warnings;
  std::size_t stroke_count = 0;
  Image source, target, result;          // shaded by shaded_map()
  Image source_strokes, target_strokes;  // the dimmed maps with the strokes in their colors
  // These show the first two coordinates. Points have the colors of texels. Points of strokes are larger and
  // have the colors of the strokes.
  Image source_space, target_space;
  Image before, after;  // the source's points before and after the warp, over the template's points (grey)
};

// Draws the pictures, and leaves the texts to the caller. The result comes from the compiled converter. Draws
// at most 16384 points of each material and 512 points of each stroke.
WarpReport warp_report(const WarpMaterial& source, const WarpMaterial& target,
                       const std::vector<StrokePair>& strokes, const WarpFit& fit);

// Throws kUsage if the name does not end with .html.
void require_report_path(const std::filesystem::path& path);

// Writes one HTML file with embedded pictures. Throws the errors of require_report_path(), and kOutput.
void write_warp_report(const std::filesystem::path& path, const WarpReport& report);

}  // namespace remap
