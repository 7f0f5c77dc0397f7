// Numbers as text, identical in every locale and on every machine.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace remap {

// The shortest text that reads back as exactly the same double; `nan` and `inf` for these values.
std::string number_text(double value);

// `value` rounded away from 0 to `digits` significant decimal digits, as reports show errors. 0 stays 0.
double rounded_up(double value, int digits);

// `value` rounded to nearest at `digits` significant decimal digits.
double rounded(double value, int digits);

// The float nearest to `value`, as a double.
double rounded_to_float(double value);

// The double of the shortest decimal text of `value`: 0.01, not 0.00999999977.
double decimal_value(float value);

// The shortest C++ float literal that reads back as `value`, with a decimal point or exponent and `f`. Throws
// kNumeric for NaN and infinity, which generated code must not hold.
std::string float_literal(float value);

// The number that the whole of `text` spells in the C locale; none for any other text.
std::optional<double> parse_number(std::string_view text);

}  // namespace remap
