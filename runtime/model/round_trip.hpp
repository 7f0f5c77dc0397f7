// There and back again: what two converters leave of a texel.
#pragma once

#include "remap/fit.hpp"

namespace remap {

// Relative changes |there and back - texel| / texel of alpha and of specular, over a grid of the part of
// `there`'s domain that it takes into `back`'s.
struct RoundTrip {
  double alpha_median = 0.0, alpha_p99 = 0.0;
  double specular_median = 0.0, specular_p99 = 0.0;
  double share = 0.0;  // of the grid that the two cover; 0: they do not meet, and there are no figures
};
RoundTrip round_trip(const Fit& there, const Fit& back);

// Whether what is left is as good as the same: medians within 0.5 %, 99th percentiles within 2 %.
bool returns(const RoundTrip& trip);

}  // namespace remap
