#include "report/stroke_overlay.hpp"

#include <algorithm>

namespace remapc {
namespace {

// Colors that color-blind readers can distinguish (Okabe and Ito 2008).
constexpr std::array<DisplayColor, 7> kStrokeColors = {{{0.84f, 0.37f, 0.00f},
                                                        {0.00f, 0.45f, 0.70f},
                                                        {0.00f, 0.62f, 0.45f},
                                                        {0.94f, 0.89f, 0.26f},
                                                        {0.80f, 0.47f, 0.65f},
                                                        {0.34f, 0.71f, 0.91f},
                                                        {0.90f, 0.62f, 0.00f}}};
constexpr float kDimmed = 0.55f;

}  // namespace

const DisplayColor& stroke_color(std::size_t stroke) { return kStrokeColors[stroke % kStrokeColors.size()]; }

Image with_strokes(const Image& picture, const PictureGrid& grid, const std::vector<StrokePair>& strokes,
                   StrokeSide side) {
  Image marked = picture;
  for (float& value : marked.values) value = 1.0f - kDimmed + kDimmed * value;
  const std::uint32_t last = *std::max_element(grid.texels.begin(), grid.texels.end());
  std::vector<int> stroke_of(std::size_t{last} + 1, -1);
  for (std::size_t k = 0; k < strokes.size(); ++k)
    for (const std::uint32_t texel : strokes[k].*side)
      if (texel <= last) stroke_of[texel] = static_cast<int>(k);
  const auto step = static_cast<std::size_t>(grid.samples), columns = grid.sample_width();
  for (std::size_t i = 0; i < grid.texels.size(); ++i) {
    const int stroke = stroke_of[grid.texels[i]];
    if (stroke < 0) continue;
    const std::size_t pixel = i / columns / step * static_cast<std::size_t>(grid.width) + i % columns / step;
    const DisplayColor& color = stroke_color(static_cast<std::size_t>(stroke));
    std::copy(color.begin(), color.end(), &marked.values[3 * pixel]);
  }
  return marked;
}

}  // namespace remapc
