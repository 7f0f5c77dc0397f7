#include "report/contact_sheet.hpp"

#include <algorithm>
#include <cstddef>

namespace remapc {

Image contact_sheet(std::size_t rows, std::size_t columns, int side) {
  Image sheet{static_cast<int>(columns) * side, static_cast<int>(rows) * side, 3, {}};
  sheet.values.assign(3 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height),
                      kSheetBackground);
  return sheet;
}

void place_picture(Image* sheet, int side, std::size_t row, std::size_t column,
                   std::span<const std::uint32_t> pixels, std::span<const float> colors) {
  const auto step = static_cast<std::size_t>(side), width = static_cast<std::size_t>(sheet->width);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t y = row * step + pixels[i] / step, x = column * step + pixels[i] % step;
    std::copy_n(&colors[3 * i], 3, &sheet->values[3 * (y * width + x)]);
  }
}

}  // namespace remapc
