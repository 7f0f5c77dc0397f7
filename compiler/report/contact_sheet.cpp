#include "report/contact_sheet.hpp"

#include <algorithm>
#include <cstddef>

namespace remap {

Image blank_picture(int width, int height, float grey) {
  Image picture{width, height, 3, {}};
  picture.values.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), grey);
  return picture;
}

Image contact_sheet(std::size_t rows, std::size_t columns, int side) {
  return blank_picture(static_cast<int>(columns) * side, static_cast<int>(rows) * side, kSheetBackground);
}

int cell_side(int resolution) { return resolution + 2 * (resolution / 20); }

std::vector<std::uint32_t> pixels_of_cell(std::vector<std::uint32_t> pixels, int resolution) {
  const auto side = static_cast<std::uint32_t>(resolution),
             width = static_cast<std::uint32_t>(cell_side(resolution)), edge = (width - side) / 2;
  for (std::uint32_t& pixel : pixels) pixel = (pixel / side + edge) * width + pixel % side + edge;
  return pixels;
}

void place_picture(Image* sheet, int side, std::size_t row, std::size_t column,
                   std::span<const std::uint32_t> pixels, std::span<const float> colors) {
  const auto step = static_cast<std::size_t>(side), width = static_cast<std::size_t>(sheet->width);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t y = row * step + pixels[i] / step, x = column * step + pixels[i] % step;
    std::copy_n(&colors[3 * i], 3, &sheet->values[3 * (y * width + x)]);
  }
}

}  // namespace remap
