// The way back through a mapping.
#pragma once

#include <optional>

#include "remap/fit.hpp"

namespace remap {

// The source parameters in `domain` that `mapping` takes to `target`, to the resolution of doubles; none
// where no such parameters are found. The mapping must rise: target alpha with alpha, target specular with
// specular at every alpha, and target alpha with alpha along a line of equal target specular; fits that ship
// do.
std::optional<MappedTexel> inverse(const MappingKind& mapping, const Domain& domain,
                                   const MappedTexel& target);

}  // namespace remap
