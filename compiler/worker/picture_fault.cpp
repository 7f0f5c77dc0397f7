#include "worker/picture_fault.hpp"

#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"

namespace remap {
namespace {

// Returns the fault of one value, or null.
const char* rule_against(float value, float least) {
  if (!std::isfinite(value)) return "values must be finite";
  if (value > kBrightestPixel) return "values must not be above 1e18";
  return value < least ? "values must not be negative" : nullptr;
}

}  // namespace

std::string picture_fault(const Image& image) {
  const auto found = std::max_element(image.values.begin(), image.values.end());
  const float least = found != image.values.end() && *found > 0.0f ? -kNegativeShare * *found : 0.0f;
  const auto channels = static_cast<std::size_t>(image.channels),
             width = static_cast<std::size_t>(image.width);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const char* rule = rule_against(image.values[i], least);
    if (rule == nullptr) continue;
    const std::size_t pixel = i / channels;
    return "the picture is " + number_text(decimal_value(image.values[i])) + " in row " +
           std::to_string(pixel / width) + ", column " + std::to_string(pixel % width) + " (" + rule + ")";
  }
  return "";
}

}  // namespace remap
