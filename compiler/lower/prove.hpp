// Proofs about a polynomial that replaces a model, by Taylor models over boxes that are halved until their
// bounds suffice.
#pragma once

#include <functional>

#include "converter/lowered.hpp"
#include "lower/taylor.hpp"

namespace remap {

// One output of a mapping as a function of doubles and of Taylor models.
using AlphaTaylor = Taylor<1, 9>;  // of alpha alone
using TexelTaylor = Taylor<2, 7>;  // of alpha (variable 0) and specular (variable 1)

struct MappedFunction {
  bool of_specular = false;  // otherwise `specular` is not looked at
  std::function<double(double alpha, double specular)> value;
  std::function<AlphaTaylor(const AlphaTaylor& alpha)> over_alpha;
  std::function<TexelTaylor(const TexelTaylor& alpha, const TexelTaylor& specular)> over_both;
};

// `evaluate(alpha, specular)` must take any scalar of evaluate.hpp.
template <typename Evaluate>
MappedFunction mapped_function(bool of_specular, Evaluate evaluate) {
  return {of_specular, [evaluate](double alpha, double specular) { return evaluate(alpha, specular); },
          [evaluate](const AlphaTaylor& alpha) { return evaluate(alpha, AlphaTaylor(1.0)); },
          [evaluate](const TexelTaylor& alpha, const TexelTaylor& specular) {
            return evaluate(alpha, specular);
          }};
}

// The value in real arithmetic, over any scalar of evaluate.hpp; for Taylor models the box lies in `cell`.
template <typename Scalar>
Scalar value_in_cell(const PiecewisePolynomial& polynomial, int cell, const Scalar& alpha,
                     const Scalar& specular) {
  const auto number = [](float value) { return static_cast<double>(value); };
  Scalar t = alpha;
  if (polynomial.pole != 0.0f)  // alpha / (alpha + pole), free of cancellation between its two alphas
    t = reciprocal(alpha + number(polynomial.pole)) * -number(polynomial.pole) + 1.0;
  Scalar u = t * number(polynomial.scale) - number(polynomial.start);
  if (polynomial.cell_count > 1) u = u - (cell + 0.5);
  const Scalar w = specular - number(polynomial.middle);
  Scalar sum = alpha * 0.0;
  const float* end =
      polynomial.coefficients.data() + static_cast<std::size_t>(cell + 1) * polynomial.coefficients_a_cell();
  for (std::size_t power = polynomial.degrees.size(); power-- > 0;) {
    const int degree = polynomial.degrees[power];
    Scalar factor = alpha * 0.0;
    for (int i = 0; i <= degree; ++i) factor = i == 0 ? factor + number(*--end) : factor * u + number(*--end);
    sum = power + 1 == polynomial.degrees.size() ? factor : sum * w + factor;
  }
  return sum;
}

struct ProofDomain {
  Range alpha;
  Range specular;
};

// A bound on |polynomial - model| in real arithmetic over the whole domain; infinite if none was found.
struct Proof {
  double bound = 0.0;
  std::size_t boxes = 0;  // examined
};

// Halves boxes until the bound is at most `target`, `box_budget` boxes have been examined, or a box shows
// that the target cannot be reached. The bound holds in each case.
Proof proven_error(const MappedFunction& model, const PiecewisePolynomial& polynomial,
                   const ProofDomain& domain, double target, std::size_t box_budget);

// A bound on |float arithmetic - real arithmetic| of the polynomial over the domain (Higham 2002, section
// 5.1: an inner product of n terms errs by at most n u / (1 - n u) times the sum of magnitudes). It includes
// texels that rounding moves into the neighbouring cell.
double rounding_error(const PiecewisePolynomial& polynomial, const ProofDomain& domain);

// Whether the polynomial is proven to rise in real arithmetic, with alpha within each cell or with specular.
bool proven_rising_with_alpha(const PiecewisePolynomial& polynomial, const ProofDomain& domain);
bool proven_rising_with_specular(const PiecewisePolynomial& polynomial, const ProofDomain& domain);

}  // namespace remap
