// This file composes a sequence of fits into one fit.
#pragma once

#include <string>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

// A ChainDifference holds the largest sampled differences over the chain's domain between a chain and its
// steps, each with its own domain rule. Colored texels differ more if alpha depends on specular. A step then
// uses the largest channel of its input, but the chain uses the source's largest channel.
struct ChainDifference {
  double alpha = 0.0;
  double grey_specular = 0.0;
  double color_specular = 0.0;
};

// Returns a fit of kind `compact` that gives the results of `steps` in sequence. An empty `id` becomes
// `<source>_to_<target>`. In its domain every step stays in its own domain. Its error figures are the steps'
// figures, propagated to the end to first order. Its image error is their sum, because errors of matching are
// systematic. Throws kUsage for fewer than 2 steps, a cycle or an invalid id. Throws kInput if the parameters
// of two neighbouring steps differ, or if their domains do not overlap.
Fit compose(const std::vector<Fit>& steps, const std::string& id = "");

// `chain` is the result of compose(steps).
ChainDifference difference_from_steps(const Fit& chain, const std::vector<Fit>& steps);

}  // namespace remap
