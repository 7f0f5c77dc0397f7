// Labels around the pictures of a sheet. Their letters are those of stb_easy_font: fonts of the machine take
// no part, so a sheet has the same bytes everywhere.
#pragma once

#include <string>
#include <vector>

#include "renderer/image.hpp"

namespace remap {

// One text for each column and row; `\n` begins a new line.
struct SheetLabels {
  std::vector<std::string> columns, rows;
};

// Returns the sheet of equal cells with the labels of columns above it and those of rows at its left. A line
// that is too long is broken at a space, and a word cut to end with "..."; lines that have no room are left
// out; a character that is not ASCII is shown as "?".
Image labelled(const Image& sheet, const SheetLabels& labels);

}  // namespace remap
