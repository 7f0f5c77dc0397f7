// This file finds values that no picture of a renderer may hold. Pictures come from a worker or from a file.
#pragma once

#include <string>

#include "look/image.hpp"

namespace remap {

// This is the brightest value of a pixel. The peak of the narrowest highlight is below 1e8. The squares of
// values beyond this limit do not fit into floats.
inline constexpr float kBrightestPixel = 1e18f;

// Filters and differences of sums leave values slightly below 0. They are accepted down to this fraction of
// the brightest value.
inline constexpr float kNegativeShare = 1e-4f;

// Returns `the picture is nan in row 3, column 5 (values must be finite)` for the first value that is not
// finite, too bright, or negative beyond rounding. Returns an empty text for a picture that can be used.
std::string picture_fault(const Image& image);

}  // namespace remap
