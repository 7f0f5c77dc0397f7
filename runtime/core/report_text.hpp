// This file sets numbers and words in columns, for reports.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/number_text.hpp"

namespace remap {

// Returns `value` with `decimals` decimals, padded on the left to `width` characters.
inline std::string fixed(double value, int decimals, int width = 0) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%*.*f", width, decimals, value);
  return text.data();
}

// Pads `text` with spaces on the right to `width` characters.
inline std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

// Returns a fraction as `12 %`, rounded to two digits.
inline std::string percent(double share) { return number_text(rounded(100.0 * share, 2)) + " %"; }

// Returns a number with its noun: `1 set`, `2 sets`.
inline std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

// Returns the values as `0.1, 0.2`.
inline std::string listed(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number_text(value);
  return text;
}

// Returns the settings of a table as comments, with one line `# key: value` per entry.
inline std::string comment_lines(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string text;
  for (const auto& [key, value] : entries) text += "# " + key + ": " + value + "\n";
  return text;
}

}  // namespace remap
