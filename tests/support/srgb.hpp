// This file has the curve of sRGB, IEC 61966-2-1, in doubles and separate from the code under test.
#pragma once

#include <cmath>

namespace remap {

inline double srgb_to_linear(double stored) {
  return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4);
}
inline double linear_to_srgb(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

}  // namespace remap
