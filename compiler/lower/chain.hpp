// This file composes a sequence of fits into one fit, inverts fits, and finds the box that is the domain of a
// fit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

// A CoveredColumn is a strip of the region: alpha from `first` to `last`, covered from specular 0 to `reach`.
struct CoveredColumn {
  double first = 0.0, last = 0.0;
  double reach = 0.0;   // 0 if the column is not covered
  bool is_gap = false;  // true if there is no data, so a box may contain this column
};

// Returns the best box within columns in rising order, or nothing if no column is covered. Outside of a
// domain, specular is extrapolated in proportion, which costs only a few tenths of a percent. Alpha is
// clamped, which is wrong. So a box with a wider range of alpha wins, unless its range of specular shrinks by
// more than the fourth power of what alpha gains.
std::optional<Domain> covered_box(const std::vector<CoveredColumn>& columns);

// A ChainDifference holds the largest differences between a chain and its steps, sampled over the chain's
// domain. The steps use their own domain rules. Colored texels differ more if alpha depends on specular,
// because a step then uses the largest channel of its input, but the chain the largest channel of the source.
struct ChainDifference {
  double alpha = 0.0;
  double grey_specular = 0.0;
  double color_specular = 0.0;
};

// Returns a fit of kind `compact` that gives the results of `steps` one after another. If `id` is empty, it
// is `<source>_to_<target>`. In its domain, every step stays in its own domain. Its errors are those of all
// steps, propagated to the end to first order. Its image error is the sum, because errors of matching are
// systematic. Throws kUsage for fewer than 2 steps, a cycle or an invalid id. Throws kInput if the parameters
// of two neighbouring steps differ, or if their domains do not overlap.
Fit compose(const std::vector<Fit>& steps, const std::string& id = "");

// `chain` is the result of compose(steps).
ChainDifference difference_from_steps(const Fit& chain, const std::vector<Fit>& steps);

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
