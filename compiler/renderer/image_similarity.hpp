// How alike two pictures look: both as a display shows them, compared by root mean square error and by
// structural similarity.
#pragma once

#include <span>
#include <vector>

namespace remapc {

// The display value, 0 to 1, of a linear value: held in [0, 1], then encoded by the transfer function of sRGB
// (IEC 61966-2-1). NaN is shown as 0.
float display_value(double linear);

// The linear value, 0 to 1, that a display value in [0, 1] stands for.
double linear_of_display(double display);

// Root mean square of a - b over all values of two pictures. 0 where they are empty.
double rms_difference(std::span<const float> a, std::span<const float> b);

// The structural similarity (Wang et al. 2004) at each pixel of two grey pictures in display values, row by
// row, `width` * `height` values each. Local means and variances are weighted by a Gaussian of 1.5 pixels,
// cut off beyond 5, over the picture mirrored at its edges; K1 = 0.01, K2 = 0.03, range 1. These are the
// numbers of scikit-image's structural_similarity(gaussian_weights=True, sigma=1.5,
// use_sample_covariance=False).
std::vector<float> similarity_map(std::span<const float> a, std::span<const float> b, int width, int height);

// The mean of the map without the 5 outermost rows and columns, as scikit-image takes it; of the whole map
// where nothing else is left.
double structural_similarity(std::span<const float> a, std::span<const float> b, int width, int height);

}  // namespace remapc
