// Source parameters from target parameters: the inverse of a mapping, and how well the converter of the other
// direction agrees with it.
#pragma once

#include <optional>

#include "lower/fit.hpp"

namespace remap {

// Returns the source parameters that the mapping of `fit` turns into `target`, to the resolution of doubles.
// They lie in the domain of `fit` and within the limits of the target model. None if they are not found. The
// mapping must be monotonic, as shipped fits are: target alpha rises with alpha; target specular rises with
// specular at every alpha; target alpha rises with alpha along a line of equal target specular.
std::optional<MappedTexel> inverse(const Fit& fit, const MappedTexel& target);

// Relative changes |there and back - texel| / texel of alpha and of specular, over the part of a grid on
// `there`'s domain that it maps into `back`'s, without limits (is_inside()) on both ways.
struct RoundTrip {
  double alpha_median = 0.0, alpha_p99 = 0.0;
  double specular_median = 0.0, specular_p99 = 0.0;
  double share = 0.0;  // of the grid that both cover; 0: no figures
};
RoundTrip round_trip(const Fit& there, const Fit& back);

// Whether the round trip is good: medians within 0.5 %, 99th percentiles within 2 %.
bool returns(const RoundTrip& trip);

}  // namespace remap
