// This file tests labels of sheets: they are next to the pictures, do not change them, and are cut if they
// are too long.
#include <catch2/catch.hpp>

#include "report/contact_sheet.hpp"

using namespace remap;

namespace {

// Returns the part of `picture` below `top` and right of `left`.
std::vector<float> part_of(const Image& picture, int left, int top) {
  std::vector<float> values;
  for (int y = top; y < picture.height; ++y)
    for (int x = 3 * left; x < 3 * picture.width; ++x)
      values.push_back(picture.values[static_cast<std::size_t>(3 * y * picture.width + x)]);
  return values;
}

}  // namespace

TEST_CASE("sheet labels: stand above and left of a sheet that stays as it is") {
  const Image sheet = blank_picture(200, 100, 0.5f);
  const Image picture = labelled(sheet, {{"source", "target"}, {"alpha 0.2\nspecular 0.5"}});
  const int left = picture.width - sheet.width, top = picture.height - sheet.height;
  CHECK(left > 20);
  CHECK(top > 8);
  CHECK(part_of(picture, left, top) == sheet.values);
  std::size_t inked = 0;
  for (const float value : picture.values)
    if (value == Approx(0.9f)) ++inked;
  CHECK(inked > 300);
}

TEST_CASE("sheet labels: letters are as large as the pictures allow") {
  const SheetLabels labels{{"source"}, {"row"}};
  const int small = labelled(blank_picture(128, 128, 0.0f), labels).height - 128;
  CHECK(labelled(blank_picture(512, 512, 0.0f), labels).height - 512 == 4 * small);
}

TEST_CASE("sheet labels: a line breaks at a space where it is too long") {
  const Image sheet = blank_picture(128, 128, 0.5f);
  CHECK(labelled(sheet, {{"equation (2) and the mean of three"}, {"row"}}).values ==
        labelled(sheet, {{"equation (2) and the\nmean of three"}, {"row"}}).values);
}

TEST_CASE("sheet labels: a long line is cut, whatever its characters and the size of the pictures") {
  const std::string name(5000, 'm');
  for (const int side : {1, 16, 128, 400}) {
    const Image sheet = blank_picture(side, side, 0.5f);
    const Image picture = labelled(sheet, {{name}, {name + "\n\xc3\xbc\n\x01"}});
    const int left = picture.width - side, top = picture.height - side;
    CHECK(left <= 180 * std::max(1, side / 128));
    CHECK(part_of(picture, left, top) == sheet.values);
    CHECK(labelled(sheet, {{name + "x"}, {name + "xyz\n??\n?"}}).values == picture.values);
  }
}
