// Strokes from painted masks, or from boxes on the command line.
#pragma once

#include <filesystem>
#include <string>

#include "warp/space/material.hpp"

namespace remapc {

// Texels of the mask above a half in any color channel. Throws kInput for a mask of another size than the
// material, one without such texels, and one that marks more than three quarters of it (most likely
// inverted).
std::vector<std::uint32_t> read_stroke(const std::filesystem::path& mask, const MapFrame& material);

// `x0,y0,x1,y1`: texels from the first corner up to, not including, the second; rows from the top. Throws
// kUsage for other text and for a box that is empty or leaves the material.
std::vector<std::uint32_t> box_stroke(const std::string& box, const MapFrame& material);

}  // namespace remapc
