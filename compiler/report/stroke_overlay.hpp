// Draws strokes on the picture of a map.
#pragma once

#include <vector>

#include "report/shaded_map.hpp"
#include "warp/space/material.hpp"

namespace remapc {

using StrokeSide = std::vector<std::uint32_t> StrokePair::*;

// The color of the stroke with this index. Seven colors are repeated.
const DisplayColor& stroke_color(std::size_t stroke);

// Dims the picture and draws one side of the strokes in their colors. `grid`: the grid of the picture.
Image with_strokes(const Image& picture, const PictureGrid& grid, const std::vector<StrokePair>& strokes,
                   StrokeSide side);

}  // namespace remapc
