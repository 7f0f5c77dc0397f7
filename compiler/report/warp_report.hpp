// A warp to look at: both materials, their strokes and appearance spaces, and the result (An et al. 2011,
// figure 1).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "renderer/image.hpp"
#include "warp/input/texture_material.hpp"
#include "warp/warp.hpp"

namespace remapc {

// Display values; maps with a longer side of 512 pixels, spaces as wide.
struct WarpPictures {
  Image source, target, result;          // as shaded_map() lights them
  Image source_strokes, target_strokes;  // the maps, dimmed, with the strokes in their colors
  // The first two coordinates: points in the colors of texels, those of strokes larger, in the strokes'
  // colors.
  Image source_space, target_space;
  Image before, after;  // the source's points over the template's, which are grey; and their images
};

// The result is what the compiled converter makes of the source. At most 16384 points of each material are
// drawn, and 512 of each stroke.
WarpPictures warp_pictures(const TextureMaterial& source, const TextureMaterial& target,
                           const std::vector<StrokePair>& strokes, const WarpFit& fit);

// What the report says in words.
struct WarpWords {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  // name and value
  std::vector<std::string> warnings;
  std::size_t stroke_count = 0;
};

// Throws kUsage for a file that is neither .html nor .png.
void require_report_path(const std::filesystem::path& path);

// One HTML file that holds its pictures; or one PNG, three pictures a row: source, template, result; the
// strokes on source and template, the source's points over the template's; both spaces, the points after the
// warp. Throws kUsage as require_report_path() does, kOutput.
void write_warp_report(const std::filesystem::path& path, const WarpPictures& pictures,
                       const WarpWords& words);

}  // namespace remapc
