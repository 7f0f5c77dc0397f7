// Strokes on the picture of a map.
#pragma once

#include <vector>

#include "report/shaded_map.hpp"
#include "warp/space/material.hpp"

namespace remapc {

using StrokeSide = std::vector<std::uint32_t> StrokePair::*;

// Of the stroke with this index; seven differ.
const DisplayColor& stroke_color(std::size_t stroke);

// The picture, dimmed, with one side of the strokes in their colors. `grid` is that of the picture.
Image with_strokes(const Image& picture, const PictureGrid& grid, const std::vector<StrokePair>& strokes,
                   StrokeSide side);

}  // namespace remapc
