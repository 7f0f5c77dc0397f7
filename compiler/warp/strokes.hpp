// This file reads strokes, which mark regions of two materials that belong together. Strokes come from masks,
// boxes or paintings. Images of strokes must have the size of the material's maps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "warp/material.hpp"

namespace remap {

// Returns the texels of the mask above 0.5 in any color channel. Throws kInput if the mask marks no texel or
// more than three quarters of them, if it cannot be read, and if its size differs from the maps.
std::vector<std::uint32_t> read_stroke(const std::filesystem::path& mask, const MaterialRef& material);

// Parses `x0,y0,x1,y1`, which means texels from the first corner to the second corner, without the second.
// Rows are counted from the top. Throws kUsage for other text, and for a box that is empty or larger than the
// material.
std::vector<std::uint32_t> box_stroke(const std::string& box, const MaterialRef& material);

// Returns one pair for each color except the background, in the row-major order of their first texels in the
// source's image. The background is transparent (alpha below 0.5) if at least 1 % of the texels are.
// Otherwise it is the most frequent color. Colors within 40 of 255 (Euclidean, stored values) are treated as
// one color, because JPEG and soft brushes vary colors. Colors of the two images match within 48. Texels at
// the edges of strokes, where colors blend, and colors of less than eight texels or 0.002 % are ignored.
// Throws kInput for an image without strokes or without flat colors and for a color in only one of the
// images. Also throws the errors of read_stroke().
std::vector<StrokePair> read_color_strokes(const std::filesystem::path& source_image,
                                           const MaterialRef& source,
                                           const std::filesystem::path& template_image,
                                           const MaterialRef& target);

}  // namespace remap
