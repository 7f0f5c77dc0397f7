// Numbers as text, the same in every locale and on every machine.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace remap {

// The shortest text that reads back as exactly the same double. `nan`, `inf` for those.
std::string number_text(double value);

// `value` rounded away from 0 to `digits` significant decimal digits: an error figure as people read it. 0
// for 0.
double rounded_up(double value, int digits);

// `value` rounded to nearest at `digits` significant decimal digits.
double rounded(double value, int digits);

// The double that a person would write for `value`: 0.01, not 0.00999999977.
double decimal_value(float value);

// A float literal of C++ (shortest that reads back, with decimal point or exponent, and `f`).
// Throws kNumeric for NaN and infinity: generated code never holds them.
std::string float_literal(float value);

// The number that the whole of `text` spells, in the C locale; none where it spells no number.
std::optional<double> parse_number(std::string_view text);

}  // namespace remap
