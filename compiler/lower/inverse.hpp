// This file finds source parameters from target parameters, which is the inverse of a mapping. It also
// measures how well the converter of the other direction agrees with this inverse.
#pragma once

#include <optional>

#include "lower/fit.hpp"

namespace remap {

// Returns the source parameters that the mapping of `fit` turns into `target`, to the resolution of doubles.
// They lie in the domain of `fit` and within the limits of the target model. Returns nothing if they are not
// found. The mapping must be monotonic, as shipped fits are. Target alpha rises with alpha. Target specular
// rises with specular at every alpha. Target alpha rises with alpha along a line of equal target specular.
std::optional<MappedTexel> inverse(const Fit& fit, const MappedTexel& target);

// A RoundTrip holds the relative changes |round trip - texel| / texel of alpha and of specular. Its texels
// are on a grid over the domain of `there`. They must arrive in the domain of `back`, without limits
// (is_inside()) in either direction.
struct RoundTrip {
  double alpha_median = 0.0, alpha_p99 = 0.0;
  double specular_median = 0.0, specular_p99 = 0.0;
  double share = 0.0;  // used fraction of the grid; if 0, the other members mean nothing
};
RoundTrip round_trip(const Fit& there, const Fit& back);

// Returns true if the round trip is good: medians within 0.5 %, 99th percentiles within 2 %.
bool returns(const RoundTrip& trip);

}  // namespace remap
