// Several converters in a row as one converter, so that maps are read and written once.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

// Runs `steps` on blocks of texels that stay in the cache; the bits are those of one step after another over
// whole rows. There must be 1 or more steps, all of width and specular and none a chain itself; they must
// outlive the result.
// - convert() counts texels outside the domain of any step, each once.
// - info(): source of the first, target of the last; the domain is chained_domain(); the errors are the sums
// of
//   the steps', the image error unknown where one is; `steps` their ids.
// - self_test(): that of every step.
// Throws kInput if a step does not take the model and parameters that the step before it makes.
std::unique_ptr<Converter> make_chained_converter(std::vector<const Converter*> steps);

// A part of the first step's domain whose images lie in the domains of all later steps: the widest range of
// width for which they do at every covered specular, then the widest range of specular, from its lower end,
// for which they do at all those widths. Found by bisection, because the mappings are monotone; its ends are
// rounded inwards to 4 digits. Returns the first step's own domain if a sample of the part has its image
// outside, or if there is no such part around the middle.
struct SourceDomain {
  Range roughness;  // the source's own width parameter
  Range specular;
};
SourceDomain chained_domain(std::span<const Converter* const> steps);

}  // namespace remap
