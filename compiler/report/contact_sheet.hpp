// Small pictures side by side, for eyes.
#pragma once

#include <cstdint>
#include <span>

#include "renderer/image.hpp"

namespace remapc {

// The display value of a sheet where nothing is shown.
inline constexpr float kSheetBackground = 0.12f;

// A dark sheet of display values for `rows` x `columns` square pictures of `side` pixels.
Image contact_sheet(std::size_t rows, std::size_t columns, int side);

// Shows a picture at a place of the sheet: three display values for each pixel in `pixels`, which counts
// through the square row by row.
void place_picture(Image* sheet, int side, std::size_t row, std::size_t column,
                   std::span<const std::uint32_t> pixels, std::span<const float> colors);

}  // namespace remapc
