// This file writes numbers as text that is identical in every locale and on every machine, and sets numbers
// and words in columns, for reports.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace remap {

// Returns the shortest text that reads back as exactly the same double, and `nan` or `inf` for these values.
std::string number_text(double value);

// Rounds `value` up in magnitude to `digits` significant decimal digits, which is how reports show errors. 0
// stays 0.
double rounded_up(double value, int digits);

// Rounds `value` to the closest number with `digits` significant decimal digits.
double rounded(double value, int digits);

// Returns the float closest to `value`, as a double.
double rounded_to_float(double value);

// Returns the double that the shortest decimal text of `value` means: 0.01, not 0.00999999977.
double decimal_value(float value);

// Returns the shortest C++ float literal that reads back as `value`, with a decimal point or exponent and
// `f`. Throws kNumeric for NaN and infinity, which generated code must not contain.
std::string float_literal(float value);

// Reads the whole of `text` as a number in the C locale. Returns nothing for any other text.
std::optional<double> parse_number(std::string_view text);

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
