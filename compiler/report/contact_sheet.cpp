#include "report/contact_sheet.hpp"

#include <algorithm>
#include <cstddef>

namespace remapc {
namespace {

constexpr int kGap = 6;  // pixels between the pictures of a sheet
constexpr float kPaper = 0.94f;

void place(const Image& picture, int left, int top, Image* sheet) {
  const auto line = static_cast<std::size_t>(3 * picture.width);
  for (int y = 0; y < picture.height; ++y) {
    const std::size_t to = 3 * static_cast<std::size_t>((top + y) * sheet->width + left);
    std::copy_n(&picture.values[static_cast<std::size_t>(y) * line], line, &sheet->values[to]);
  }
}

}  // namespace

Image blank_picture(int width, int height, float grey) {
  Image picture{width, height, 3, {}};
  picture.values.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), grey);
  return picture;
}

Image contact_sheet(std::size_t rows, std::size_t columns, int side) {
  return blank_picture(static_cast<int>(columns) * side, static_cast<int>(rows) * side, kSheetBackground);
}

void place_picture(Image* sheet, int side, std::size_t row, std::size_t column,
                   std::span<const std::uint32_t> pixels, std::span<const float> colors) {
  const auto step = static_cast<std::size_t>(side), width = static_cast<std::size_t>(sheet->width);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t y = row * step + pixels[i] / step, x = column * step + pixels[i] % step;
    std::copy_n(&colors[3 * i], 3, &sheet->values[3 * (y * width + x)]);
  }
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
