// This file composes a sequence of fits into one fit.
#pragma once

#include <string>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

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

}  // namespace remap
