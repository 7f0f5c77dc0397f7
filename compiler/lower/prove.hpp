// This file proves properties of a form that replaces a mapping. It uses Taylor models over boxes, which it
// halves until their bounds suffice, and an analysis of rounding errors.
#pragma once

#include "lower/fit.hpp"

namespace remap {

// Returns bounds on |form - mapping| in real arithmetic over the whole domain, for target alpha and target
// specular below the limits. They are infinite if none was found. Halves boxes until the bounds are at most
// `target`, until it has examined `box_budget` boxes for each bound, or until a box shows that `target`
// cannot be reached.
MappedTexel proven_distance(const MappingKind& mapping, const CompactForm& form, const Domain& domain,
                            const MappedTexel& target, std::size_t box_budget);

// Returns bounds on |float arithmetic - real arithmetic| of the form over the domain. By Horner's rule, a sum
// of products errs by at most 2 n u / (1 - 2 n u) times the sum of magnitudes (Higham 2002, section 5.1).
MappedTexel rounding_of(const CompactForm& form, const Domain& domain);

}  // namespace remap
