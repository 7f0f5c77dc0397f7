// Numbers and words in columns, as reports for people have them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "text/number_text.hpp"

namespace remapc {

// With that many decimals, and spaces before it where it is shorter than `width`.
inline std::string fixed(double value, int decimals, int width = 0) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%*.*f", width, decimals, value);
  return text.data();
}

// With spaces behind it, or before it, where it is shorter.
inline std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}
inline std::string padded_left(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

// `12 %`, two digits.
inline std::string percent(double share) {
  return remap::number_text(remap::rounded(100.0 * share, 2)) + " %";
}

// `0.1, 0.2`.
inline std::string listed(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + remap::number_text(value);
  return text;
}

// What the rows of a table depend on: `# key: value`, a line each.
inline std::string comment_lines(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string text;
  for (const auto& [key, value] : entries) text += "# " + key + ": " + value + "\n";
  return text;
}

}  // namespace remapc
