// This file makes sheets of small pictures for visual comparison, with labels around the pictures. The
// letters come from stb_easy_font, not from fonts of the machine, so a sheet has the same bytes everywhere.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "look/image.hpp"

namespace remap {

// This is the display value of a sheet outside its pictures.
inline constexpr float kSheetBackground = 0.12f;

// Returns a dark sheet of display values for `rows` x `columns` square pictures of `side` pixels.
Image contact_sheet(std::size_t rows, std::size_t columns, int side);

// Returns the side of a cell for pictures of `resolution` pixels. A cell has a margin of a twentieth around
// its picture.
int cell_side(int resolution);

// Returns pixels of a square picture as pixels of a cell. Both are row-major indices.
std::vector<std::uint32_t> pixels_of_cell(std::vector<std::uint32_t> pixels, int resolution);

// Copies a picture to a cell of the sheet. `pixels` are row-major indices into the square. `colors` has three
// display values for each of them.
void place_picture(Image* sheet, int side, std::size_t row, std::size_t column,
                   std::span<const std::uint32_t> pixels, std::span<const float> colors);

// Returns a picture of one grey value.
Image blank_picture(int width, int height, float grey);

// A SheetLabels holds one text for each column and row; `\n` begins a new line.
struct SheetLabels {
  std::vector<std::string> columns, rows;
};

// Returns the sheet with column labels above its equal cells and row labels at the left. A line that is too
// long is broken at a space. A word that is too long is cut, and ends with "...". Lines without room are left
// out. A character that is not ASCII is shown as "?".
Image labelled(const Image& sheet, const SheetLabels& labels);

}  // namespace remap
