// Proofs about a form that replaces a mapping, by Taylor models over boxes that are halved until their bounds
// suffice, and by rounding error analysis.
#pragma once

#include "lower/fit.hpp"

namespace remap {

// In target alpha and target specular, below the limits.
struct Distance {
  double alpha = 0.0, specular = 0.0;
};

// Bounds on |form - mapping| in real arithmetic over the whole domain; infinite where none was found. Halves
// boxes until the bounds are at most `target`, `box_budget` boxes have been examined for each, or a box shows
// that the target cannot be reached.
Distance proven_distance(const MappingKind& mapping, const CompactForm& form, const Domain& domain,
                         const Distance& target, std::size_t box_budget);

// Bounds on |float arithmetic - real arithmetic| of the form over the domain (Higham 2002, section 5.1: a sum
// of products by Horner's rule errs by at most 2 n u / (1 - 2 n u) times the sum of magnitudes).
Distance rounding_of(const CompactForm& form, const Domain& domain);

}  // namespace remap
