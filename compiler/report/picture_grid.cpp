#include "report/picture_grid.hpp"

#include <algorithm>
#include <cmath>

namespace remapc {
namespace {

constexpr int kMostSamples = 3;
constexpr int kGap = 6;  // pixels between the pictures of a sheet
constexpr float kPaper = 0.94f;

std::size_t texel_at(int sample, int sample_count, std::size_t texel_count) {
  const double place = (static_cast<double>(sample) + 0.5) / static_cast<double>(sample_count);
  return std::min(static_cast<std::size_t>(place * static_cast<double>(texel_count)), texel_count - 1);
}

void place(const Image& picture, int left, int top, Image* sheet) {
  const auto line = static_cast<std::size_t>(3 * picture.width);
  for (int y = 0; y < picture.height; ++y) {
    const std::size_t to = 3 * static_cast<std::size_t>((top + y) * sheet->width + left);
    std::copy_n(&picture.values[static_cast<std::size_t>(y) * line], line, &sheet->values[to]);
  }
}

}  // namespace

PictureGrid picture_grid(std::size_t width, std::size_t height, int side) {
  const auto longer = static_cast<double>(std::max(width, height));
  const double scale = static_cast<double>(side) / longer;
  const auto pixels = [&](std::size_t texels) {
    return std::max(static_cast<int>(std::lround(static_cast<double>(texels) * scale)), 1);
  };
  PictureGrid grid;
  grid.width = pixels(width);
  grid.height = pixels(height);
  grid.samples = std::clamp(static_cast<int>(std::ceil(1.0 / scale - 1e-9)), 1, kMostSamples);
  const int columns = grid.width * grid.samples, rows = grid.height * grid.samples;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      grid.texels.push_back(
          static_cast<std::uint32_t>(texel_at(y, rows, height) * width + texel_at(x, columns, width)));
  return grid;
}

std::vector<remap::WarpTexel> samples_of(const PictureGrid& grid,
                                         const std::vector<remap::WarpTexel>& texels) {
  std::vector<remap::WarpTexel> samples;
  samples.reserve(grid.texels.size());
  for (const std::uint32_t texel : grid.texels) samples.push_back(texels[texel]);
  return samples;
}

Image blank_picture(int width, int height, float grey) {
  Image picture{width, height, 3, {}};
  picture.values.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), grey);
  return picture;
}

Image sheet_of(const std::vector<std::vector<Image>>& rows) {
  int cell_width = 0, columns = 0, height = kGap;
  std::vector<int> heights;
  for (const std::vector<Image>& row : rows) {
    columns = std::max(columns, static_cast<int>(row.size()));
    heights.push_back(0);
    for (const Image& picture : row) {
      cell_width = std::max(cell_width, picture.width);
      heights.back() = std::max(heights.back(), picture.height);
    }
    height += heights.back() + kGap;
  }
  Image sheet = blank_picture(columns * (cell_width + kGap) + kGap, height, kPaper);
  int top = kGap;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    int left = kGap;
    for (const Image& picture : rows[r]) {
      place(picture, left + (cell_width - picture.width) / 2, top + (heights[r] - picture.height) / 2,
            &sheet);
      left += cell_width + kGap;
    }
    top += heights[r] + kGap;
  }
  return sheet;
}

}  // namespace remapc
