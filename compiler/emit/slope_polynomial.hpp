// Turns the exponentials of a slope k(alpha) into one polynomial, which vectorises to a fraction of their
// cost, with a proven bound on the difference.
#pragma once

#include <optional>
#include <vector>

#include "model/fit.hpp"

namespace remapc {

// P(alpha) = sum of coefficients[i] (alpha - centre)^i. Coefficients and centre are exact floats.
struct SlopePolynomial {
  double centre = 0.0;
  std::vector<double> coefficients;
  double bound = 0.0;  // proven: |P - k| stays within it on the whole range, in exact arithmetic
};

// The polynomial of lowest degree, at most `max_degree`, whose bound is within `tolerance`; none where no
// such polynomial exists. It interpolates k at Chebyshev nodes. The bound is the largest error on a grid plus
// what the error can grow between its points, from bounds on the second derivatives of k and P.
std::optional<SlopePolynomial> approximate_slope(const remap::Parametric& form, const remap::Range& alpha,
                                                 double tolerance, int max_degree);

}  // namespace remapc
