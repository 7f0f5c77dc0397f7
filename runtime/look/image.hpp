// This file holds a linear float image, the result of a renderer and the input of the match.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace remap {

// An Image is linear radiance, `channels` interleaved values per pixel. Row 0 is at the top, column 0 at -x.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> values;
};

// An Rgb is linear RGB with the primaries of sRGB.
using Rgb = std::array<double, 3>;

// Returns the luminance of linear RGB (ITU-R BT.709), or the luma of display values.
inline double luminance(const float* rgb) {
  return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
         0.0722 * static_cast<double>(rgb[2]);
}

}  // namespace remap
