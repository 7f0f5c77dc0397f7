// The value of a lowered polynomial in real arithmetic, over any scalar.
#pragma once

#include "lower/lowered.hpp"
#include "model/evaluate.hpp"

namespace remap {

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

}  // namespace remap
