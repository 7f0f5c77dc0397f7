// Fits one after another, composed into one fit.
#pragma once

#include <string>
#include <vector>

#include "remap/fit.hpp"

namespace remap {

// How far a chain is from its steps applied one after another, each with its own domain rule, over the
// chain's domain: sampled, largest difference in the target's alpha and in its specular. Grey texels differ
// where a step maps specular below 0, which it holds at 0 and the chain does not. Colored ones differ
// besides where the width depends on specular: a step follows the width of the largest channel, the chain
// that of each.
struct ChainDifference {
  double alpha = 0.0;
  double grey_specular = 0.0;
  double color_specular = 0.0;
};

// The fit of kind `chain` that applies `steps` in turn; steps that are chains themselves are taken apart.
// `id`: empty for `<source>_to_<target>`. Its domain is where every step stays in its own domain. Its error
// figures are those of the steps carried on to the end to first order, and its image error their sum: errors
// of matching are systematic. Throws kUsage for fewer than 2 steps, a cycle and an id that is no identifier;
// kInput where a step does not take the parameters that the one before it gives, and where domains do not
// meet.
Fit compose(const std::vector<Fit>& steps, const std::string& id = "");

// `chain`: what compose() made of `steps`.
ChainDifference difference_from_steps(const Fit& chain, const std::vector<Fit>& steps);

}  // namespace remap
