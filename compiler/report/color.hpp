// Linear RGB with the primaries of sRGB.
#pragma once

#include <array>

namespace remapc {

using Rgb = std::array<double, 3>;

// The luminance of linear RGB (ITU-R BT.709), or the luma of display values.
inline double luminance(const float* rgb) {
  return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
         0.0722 * static_cast<double>(rgb[2]);
}

}  // namespace remapc
