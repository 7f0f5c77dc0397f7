// This file compares two pictures as displayed, by root mean square error and structural similarity.
#pragma once

#include <span>
#include <vector>

namespace remap {

// Converts a linear value to a display value: clamps it to [0, 1] and applies the sRGB transfer function (IEC
// 61966-2-1). NaN becomes 0.
float display_value(double linear);

// Converts a display value in [0, 1] back to the linear value, 0 to 1.
double linear_of_display(double display);

// Returns the root mean square of a - b over all values of two pictures, and 0 for empty ones.
double rms_difference(std::span<const float> a, std::span<const float> b);

// Returns the structural similarity (Wang et al. 2004) at each pixel of two grey pictures in display values,
// row by row, `width` * `height` values each. A Gaussian of sigma 1.5 pixels, truncated at 5 pixels, weighs
// the local means and variances. Pictures are mirrored at their edges; K1 = 0.01, K2 = 0.03, range 1. The
// result equals scikit-image's structural_similarity(gaussian_weights=True, sigma=1.5,
// use_sample_covariance=False).
std::vector<float> similarity_map(std::span<const float> a, std::span<const float> b, int width, int height);

// Returns the mean of similarity_map() without its 5 outermost rows and columns, as scikit-image does. If
// nothing is left, returns the mean of the whole map.
double structural_similarity(std::span<const float> a, std::span<const float> b, int width, int height);

}  // namespace remap
