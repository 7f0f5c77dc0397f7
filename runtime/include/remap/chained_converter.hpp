// Converters one after another as one converter, so that maps are read and written once.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

// Runs `steps` (1 or more, none of them chained itself; they must outlive the result) on blocks of texels
// that stay in the cache, and gives the bits that they give one after another over whole rows. Takes the
// numbers of channels that all of them take.
// - convert() counts texels outside the domain of any step, each once.
// - info(): source of the first, target of the last; the domain is chained_domain(); the errors are the sums
// of
//   the steps', the image error unknown where one is; `steps` their ids.
// - self_test(): that of every step.
// Throws kInput where a step does not take the model, or the parameters of it, that the one before gives.
std::unique_ptr<Converter> make_chained_converter(std::vector<const Converter*> steps);

// A part of the first step's domain whose images lie in the domains of all later steps: the widest range of
// widths whose images do for every covered specular, then the widest range of specular from the lower end
// whose images do for all those widths. Found by bisection, since the mappings are monotone, and its ends
// rounded inwards to 4 digits; the whole of it is then sampled, and the first step's own domain is returned
// where a sample has its image outside, or where there is no such part around the middle.
struct SourceDomain {
  Range roughness;  // the source's own width parameter
  Range specular;
};
SourceDomain chained_domain(std::span<const Converter* const> steps);

}  // namespace remap
