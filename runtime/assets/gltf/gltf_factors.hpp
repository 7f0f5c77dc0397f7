// Factors of glTF materials, with their text: a number that no conversion changes stays as it is written.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"
#include "core/json_spans.hpp"
#include "core/number_text.hpp"

namespace remap {

// A factor from 0 to 1, as the file writes it or as it is clamped.
struct FactorText {
  double value = 1.0;
  std::string text = "1";
};

// The shortest text that reads back as the float.
inline std::string float_text(float value) { return number_text(decimal_value(value)); }

// Reads the factors of one object, and notes those that it clamps. Throws kInput for other values than
// numbers.
class FactorReader {
 public:
  static constexpr double kNoLimit = std::numeric_limits<double>::max();

  // Either must outlive it. `object` may be none.
  FactorReader(SpanValue object, std::vector<std::string>& warnings) : object_(object), warnings_(warnings) {}

  // Without the member, `factor` stays.
  void read(const char* name, FactorText& factor, double most = 1.0) const;
  template <std::size_t Count>
  void read(const char* name, std::array<FactorText, Count>& factors, double most = 1.0) const {
    const std::vector<SpanValue> entries = entries_of(name, Count);
    for (std::size_t i = 0; i < entries.size(); ++i) factors[i] = read_number(entries[i], name, most);
  }

 private:
  std::vector<SpanValue> entries_of(const char* name, std::size_t count) const;
  FactorText read_number(SpanValue value, const std::string& name, double most) const;

  SpanValue object_;
  std::vector<std::string>& warnings_;
};

// Arithmetic of floats moves a factor by less.
inline constexpr double kSameFactor = 1e-6;

// The text of `own` where it is that number, else a text of the number.
inline bool is_factor(float value, const FactorText& own) {
  return std::fabs(static_cast<double>(value) - own.value) < kSameFactor;
}
inline std::string factor_text(float value, const FactorText& own) {
  return is_factor(value, own) ? own.text : float_text(value);
}

// `[1,0.5,0]`.
std::string list_text(const std::vector<std::string>& entries);

// A factor of a map that has one value everywhere.
void multiply(FactorText& factor, float value);

// Values as a report gives them.
MaterialFactor reported(std::string name, const std::vector<float>& values);

}  // namespace remap
