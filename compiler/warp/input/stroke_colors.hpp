// Strokes painted in two images, a color for each pair.
#pragma once

#include <filesystem>
#include <vector>

#include "warp/space/material.hpp"

namespace remapc {

// Pairs of all colors but the background's, in the order in which they first appear in the source's image,
// row by row. The background is what is transparent (alpha below a half), where that is 1 % or more; else the
// most frequent color. Colors within 40 of 255 (Euclidean, stored values) are one, as JPEG and soft brushes
// leave them; the two images' may differ by 48. Rims of strokes, where colors blend, and colors of less
// than eight texels or 0.002 % are part of none. Throws kInput as read_stroke_image() and
// require_background() do, where an image has no stroke or is no painting in flat colors, and for a color
// that one image alone has.
std::vector<StrokePair> read_color_strokes(const std::filesystem::path& source_image, const MapFrame& source,
                                           const std::filesystem::path& template_image,
                                           const MapFrame& target);

}  // namespace remapc
