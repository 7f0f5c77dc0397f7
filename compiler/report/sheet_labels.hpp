// This file draws labels around the pictures of a sheet. The letters come from stb_easy_font, not from fonts
// of the machine, so a sheet has the same bytes everywhere.
#pragma once

#include <string>
#include <vector>

#include "look/image.hpp"

namespace remap {

// A SheetLabels holds one text for each column and row; `\n` begins a new line.
struct SheetLabels {
  std::vector<std::string> columns, rows;
};

// Returns the sheet with column labels above its equal cells and row labels at the left. A line that is too
// long is broken at a space. A word that is too long is cut, and ends with "...". Lines without room are left
// out. A character that is not ASCII is shown as "?".
Image labelled(const Image& sheet, const SheetLabels& labels);

}  // namespace remap
