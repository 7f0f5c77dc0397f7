#include "text/number_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "remap/error.hpp"

namespace remap {

std::string number_text(double value) {
  std::array<char, 64> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return std::string(buffer.data(), end);
}

double rounded_up(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  const double magnitude = std::floor(std::log10(std::fabs(value)));
  const double scale = std::pow(10.0, digits - 1 - magnitude);
  // The margin absorbs rounding errors of the scaling: 0.07 becomes 7.000000000000001 hundredths.
  const double scaled = std::ceil(std::fabs(value) * scale * (1.0 - 1e-14));
  return std::copysign(scale >= 1.0 ? scaled / scale : scaled * std::pow(10.0, magnitude - digits + 1),
                       value);
}

double rounded(double value, int digits) {
  std::array<char, 40> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits - 1)
          .ptr;
  return parse_number(std::string_view(text.data(), end)).value_or(value);
}

// The float lies in memory: gcc 12 at -O3 drops the rounding of two neighbours that it converts as a vector.
double rounded_to_float(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

double decimal_value(float value) {
  std::array<char, 64> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  double decimal = static_cast<double>(value);
  std::from_chars(buffer.data(), end, decimal);
  return decimal;
}

std::string float_literal(float value) {
  if (!std::isfinite(value)) throw Error(ErrorKind::kNumeric, "emit: a coefficient is not finite");
  std::array<char, 64> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "f";
}

std::optional<double> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace remap
