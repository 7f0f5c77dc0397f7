#include "core/number_text.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/errors.hpp"

namespace remap {
namespace {

#if defined(__cpp_lib_to_chars)

// Returns the shortest decimal number that reads back as `value`.
template <typename Float>
std::string shortest(Float value) {
  std::array<char, 64> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string scientific(double value, int digits) {
  std::array<char, 40> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                       std::chars_format::scientific, digits - 1)
                             .ptr};
}

// Reads the number at the start of `text`. Returns the length of its text, or 0 if there is no number.
std::size_t read(std::string_view text, double* value) {
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), *value);
  return failure == std::errc() ? static_cast<std::size_t>(end - text.data()) : 0;
}

#else  // libc++ before 20 uses the C library, in the locale "C", which no program changes

std::string printed(const char* format, int digits, double value) {
  std::array<char, 400> buffer;
  std::snprintf(buffer.data(), buffer.size(), format, digits, value);
  return buffer.data();
}

// Formats like std::to_chars: with the fewest digits, then the shortest text. It uses an exponent only if
// that is shorter.
template <typename Float>
std::string shortest(Float value) {
  const double number = static_cast<double>(value);
  if (!std::isfinite(value)) return printed("%.*f", 0, number);
  int digits = 1;
  const auto is_read_back = [&](const std::string& text) {
    return static_cast<Float>(std::strtod(text.c_str(), nullptr)) == value;
  };
  while (!is_read_back(printed("%.*e", digits - 1, number))) ++digits;
  const std::string exponent = printed("%.*e", digits - 1, number);
  const int power = std::atoi(exponent.c_str() + exponent.find('e') + 1);
  const std::string plain = printed("%.*f", std::max(0, digits - 1 - power), number);
  return plain.size() <= exponent.size() ? plain : exponent;
}

std::string scientific(double value, int digits) { return printed("%.*e", digits - 1, value); }

std::size_t read(std::string_view text, double* value) {
  // strtod accepts three things that from_chars refuses: leading spaces, a plus sign and hexadecimal numbers.
  if (text.find_first_of(" \t\n\v\f\r+") == 0 || text.find_first_of("xX") != std::string_view::npos) return 0;
  const std::string ended(text);
  char* end = nullptr;
  errno = 0;
  *value = std::strtod(ended.c_str(), &end);
  const bool is_out_of_range = errno == ERANGE && (*value == 0.0 || !std::isfinite(*value));
  return is_out_of_range ? 0 : static_cast<std::size_t>(end - ended.c_str());
}

#endif

}  // namespace

std::string number_text(double value) { return shortest(value); }

double rounded_up(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  const double magnitude = std::floor(std::log10(std::fabs(value)));
  const double scale = std::pow(10.0, digits - 1 - magnitude);
  // The margin compensates for rounding in the scaling, which makes 0.07 into 7.000000000000001 hundredths.
  const double scaled = std::ceil(std::fabs(value) * scale * (1.0 - 1e-14));
  return std::copysign(scale >= 1.0 ? scaled / scale : scaled * std::pow(10.0, magnitude - digits + 1),
                       value);
}

double rounded(double value, int digits) { return parse_number(scientific(value, digits)).value_or(value); }

// Keeps the float in memory, because otherwise gcc 12 at -O3 does not round two neighbours in a vector.
double rounded_to_float(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

double decimal_value(float value) {
  return parse_number(shortest(value)).value_or(static_cast<double>(value));
}

std::string float_literal(float value) {
  if (!std::isfinite(value)) throw numeric_error("emit: a coefficient is not finite");
  std::string text = shortest(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "f";
}

std::optional<double> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  if (text.empty() || read(text, &value) != text.size()) return std::nullopt;
  return value;
}

}  // namespace remap
