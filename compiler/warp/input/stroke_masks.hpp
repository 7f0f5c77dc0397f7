// Reads strokes from painted masks or from boxes of the command line.
#pragma once

#include <filesystem>
#include <string>

#include "warp/space/material.hpp"

namespace remapc {

// Returns the texels of the mask above 0.5 in any color channel. Throws kInput if the size of the mask
// differs from that of the material, if it marks no texel, and if it marks more than three quarters (most
// likely inverted).
std::vector<std::uint32_t> read_stroke(const std::filesystem::path& mask, const MapFrame& material);

// Parses `x0,y0,x1,y1`: texels from the first corner up to but excluding the second; rows count from the top.
// Throws kUsage for other text and for a box that is empty or exceeds the material.
std::vector<std::uint32_t> box_stroke(const std::string& box, const MapFrame& material);

}  // namespace remapc
