// Reads strokes from two painted images, with one color for each pair.
#pragma once

#include <filesystem>
#include <vector>

#include "warp/space/material.hpp"

namespace remapc {

// Returns one pair for each color except the background, in the row-major order of their first texels in the
// source's image. The background is transparent (alpha below 0.5) if at least 1 % of the texels are;
// otherwise it is the most frequent color. Colors within 40 of 255 (Euclidean, stored values) count as one
// color, because JPEG and soft brushes vary colors; colors of the two images match within 48. Texels at the
// edges of strokes, where colors blend, and colors of less than eight texels or 0.002 % are ignored. Throws
// kInput for an image without strokes or without flat colors and for a color in only one of the images, and
// the errors of read_stroke_image() and require_background().
std::vector<StrokePair> read_color_strokes(const std::filesystem::path& source_image, const MapFrame& source,
                                           const std::filesystem::path& template_image,
                                           const MapFrame& target);

}  // namespace remapc
