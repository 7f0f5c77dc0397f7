// This file writes numbers as text that is identical in every locale and on every machine.
#pragma once

#include <optional>
#include <string>
#include <string_view>

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

}  // namespace remap
