#include "report/contact_sheet.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stb/stb_easy_font.h>

#include "core/plain_text.hpp"

namespace remap {
namespace {

// These are in dots of the font: the distance between lines, and the margin on each side of a text.
constexpr int kLineHeight = 11, kTextMargin = 5;
constexpr int kCellOfDots = 128;  // dots along the side of a cell
constexpr int kRowDots = 170;     // longest label of a row, in dots
constexpr int kMostLines = 9;
constexpr float kInk = 0.9f;

using TextLines = std::vector<std::string>;

int width_in_dots(std::string line) { return stb_easy_font_width(line.data()); }

// Returns the place of the last space with at most `room` dots before it, or npos if there is none.
std::size_t line_break(const std::string& line, int room) {
  std::size_t space = line.rfind(' ');
  while (space != std::string::npos && width_in_dots(line.substr(0, space)) > room)
    space = space == 0 ? std::string::npos : line.rfind(' ', space - 1);
  return space;
}

// Returns the lines of a label. There are at most `most` lines, and each is at most `room` dots wide.
TextLines shown_lines(const std::string& label, int room, int most) {
  TextLines lines = parts_between(label, '\n');
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string line = lines[i];
    std::ranges::replace_if(
        line, [](char c) { return c < ' ' || c > '~'; }, '?');
    if (width_in_dots(line) > room) {
      if (const std::size_t space = line_break(line, room); space != std::string::npos) {
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(i) + 1, line.substr(space + 1));
        line.resize(space);
      } else {
        line += "...";
        while (line.size() > 3 && width_in_dots(line) > room) line.erase(line.size() - 4, 1);
        if (width_in_dots(line) > room) line.clear();
      }
    }
    lines[i] = line;
  }
  lines.resize(std::min(lines.size(), static_cast<std::size_t>(most)));
  return lines;
}

std::vector<TextLines> shown_labels(const std::vector<std::string>& labels, int room, int most_lines) {
  std::vector<TextLines> shown;
  for (const std::string& label : labels) shown.push_back(shown_lines(label, room, most_lines));
  return shown;
}

// Draws a line with its upper left corner at x, y (in pixels).
void draw_line(std::string line, int x, int y, int dot, Image* picture) {
  struct Corner {
    float x = 0.0f, y = 0.0f, z = 0.0f;
    std::array<unsigned char, 4> color{};
  };
  constexpr std::size_t kBarsAtMost = 16;  // largest number of bars of a letter
  std::vector<std::array<Corner, 4>> bars(kBarsAtMost * line.size());
  bars.resize(static_cast<std::size_t>(stb_easy_font_print(0.0f, 0.0f, line.data(), nullptr, bars.data(),
                                                           static_cast<int>(sizeof(bars[0]) * bars.size()))));
  for (const std::array<Corner, 4>& bar : bars) {
    const auto pixels = [&](float dots, int start, int end) {
      return std::clamp(start + dot * static_cast<int>(dots), 0, end);
    };
    const int left = pixels(bar[0].x, x, picture->width), right = pixels(bar[2].x, x, picture->width);
    for (int row = pixels(bar[0].y, y, picture->height); row < pixels(bar[2].y, y, picture->height); ++row)
      std::fill_n(&picture->values[3 * static_cast<std::size_t>(row * picture->width + left)],
                  3 * (right - left), kInk);
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

Image labelled(const Image& sheet, const SheetLabels& labels) {
  const int cell_width = sheet.width / static_cast<int>(labels.columns.size());
  const int cell_height = sheet.height / static_cast<int>(labels.rows.size());
  const int dot = std::max(1, cell_width / kCellOfDots);
  const std::vector<TextLines> columns =
      shown_labels(labels.columns, cell_width / dot - 2 * kTextMargin, kMostLines);
  const std::vector<TextLines> rows =
      shown_labels(labels.rows, kRowDots, std::min(kMostLines, cell_height / (dot * kLineHeight)));
  int left = 0;
  std::size_t most_lines = 0;
  for (const TextLines& lines : rows)
    for (const std::string& line : lines)
      left = std::max(left, dot * (width_in_dots(line) + 2 * kTextMargin));
  for (const TextLines& lines : columns) most_lines = std::max(most_lines, lines.size());
  const int top = dot * (static_cast<int>(most_lines) * kLineHeight + kTextMargin);

  Image picture = blank_picture(left + sheet.width, top + sheet.height, kSheetBackground);
  for (int y = 0; y < sheet.height; ++y)
    std::copy_n(&sheet.values[3 * static_cast<std::size_t>(y * sheet.width)], 3 * sheet.width,
                &picture.values[3 * static_cast<std::size_t>((top + y) * picture.width + left)]);
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t i = 0; i < columns[c].size(); ++i) {
      const int middle = left + static_cast<int>(c) * cell_width + cell_width / 2;
      draw_line(columns[c][i], middle - dot * width_in_dots(columns[c][i]) / 2,
                dot * (kTextMargin + static_cast<int>(i) * kLineHeight), dot, &picture);
    }
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t i = 0; i < rows[r].size(); ++i) {
      const int first = top + static_cast<int>(r) * cell_height +
                        (cell_height - dot * kLineHeight * static_cast<int>(rows[r].size())) / 2;
      draw_line(rows[r][i], dot * kTextMargin, first + dot * static_cast<int>(i) * kLineHeight, dot,
                &picture);
    }
  return picture;
}

}  // namespace remap
