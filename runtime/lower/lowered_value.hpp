// The order of operations of lowered polynomials, over any scalar.
#pragma once

#include "lower/lowered.hpp"
#include "model/evaluate.hpp"

namespace remap {

// From this degree on the even and the odd powers are summed apart: a processor works on both sums at once.
inline constexpr int kShortestSplit = 4;

// c[0] + c[1] u + ... + c[degree] u^degree in the order of operations of generated code. `square`: u * u.
// `times_plus(a, x, b)`: a * x + b.
template <typename Number, typename TimesPlus>
Number in_emitted_order(const float* c, int degree, const Number& u, const Number& square,
                        const TimesPlus& times_plus) {
  if (degree < 0) return Number{};
  Number sum{c[degree]};
  if (degree < kShortestSplit) {
    for (int i = degree - 1; i >= 0; --i) sum = times_plus(sum, u, Number{c[i]});
    return sum;
  }
  Number next{c[degree - 1]};
  for (int i = degree - 2; i >= 0; --i) {
    Number& same = (degree - i) % 2 == 0 ? sum : next;
    same = times_plus(same, square, Number{c[i]});
  }
  return degree % 2 == 0 ? times_plus(next, u, sum) : times_plus(sum, u, next);
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

}  // namespace remap
