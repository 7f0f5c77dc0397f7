// Finds values that no picture of a renderer may hold, whether a worker has just made it or a file has kept
// it.
#pragma once

#include <string>

#include "renderer/image.hpp"

namespace remap {

// The brightest value of a pixel. The peak of the narrowest highlight is below 1e8; the squares of values
// beyond this limit are no floats.
inline constexpr float kBrightestPixel = 1e18f;

// Filters and differences of sums leave values slightly below 0. They are accepted down to this fraction of
// the brightest value.
inline constexpr float kNegativeShare = 1e-4f;

// `the picture is nan in row 3, column 5 (values must be finite)` for the first value that is not finite, too
// bright, or negative beyond rounding; empty for a picture that can be used.
std::string picture_fault(const Image& image);

}  // namespace remap
