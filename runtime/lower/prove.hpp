// Proofs about a polynomial in place of a model, by Taylor models over boxes that are halved where they are
// too coarse.
#pragma once

#include "lower/lowered.hpp"
#include "lower/mapped_function.hpp"

namespace remap {

// Where a function is to be proven.
struct ProofDomain {
  Range alpha;
  Range specular;
};

// A bound on |polynomial - model| in real arithmetic over the whole domain, infinite where none was found.
struct Proof {
  double bound = 0.0;
  std::size_t boxes = 0;  // looked at
};

// Halves boxes until the bound is at most `target`, or `box_budget` boxes have been looked at, or it shows
// that it will not get there; the bound holds in any case.
Proof proven_error(const MappedFunction& model, const PiecewisePolynomial& polynomial,
                   const ProofDomain& domain, double target, std::size_t box_budget);

// A bound on |float arithmetic - real arithmetic| of the polynomial over the domain (Higham 2002, section
// 5.1: an inner product of n terms errs by at most n u / (1 - n u) times the sum of magnitudes), a
// neighbouring cell's polynomial next to a joint included.
double rounding_error(const PiecewisePolynomial& polynomial, const ProofDomain& domain);

// Whether the polynomial is proven to rise, in real arithmetic: with alpha within each cell, or with
// specular.
bool proven_rising_with_alpha(const PiecewisePolynomial& polynomial, const ProofDomain& domain);
bool proven_rising_with_specular(const PiecewisePolynomial& polynomial, const ProofDomain& domain);

}  // namespace remap
