// Composes a sequence of fits into one fit.
#pragma once

#include <string>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

// The largest sampled differences over the chain's domain between a chain and its steps, each applied with
// its own domain rule. Colored texels differ more where alpha depends on specular: a step takes the largest
// channel of what it gets, the chain that of the source.
struct ChainDifference {
  double alpha = 0.0;
  double grey_specular = 0.0;
  double color_specular = 0.0;
};

// A fit of kind `compact` that gives what `steps` give in order. `id`: empty for
// `<source>_to_<target>`. In its domain every step stays in its own domain. Its error figures are those of
// the steps, propagated to the end to first order; its image error is their sum, because errors of matching
// are systematic. Throws kUsage for fewer than 2 steps, a cycle or an invalid id; kInput if the parameters of
// two neighbouring steps differ, or if their domains do not overlap.
Fit compose(const std::vector<Fit>& steps, const std::string& id = "");

// `chain`: the result of compose(steps).
ChainDifference difference_from_steps(const Fit& chain, const std::vector<Fit>& steps);

}  // namespace remap
