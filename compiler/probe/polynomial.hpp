// Polynomials in one variable as their coefficients, ascending powers: how a loss depends on specular.
#pragma once

#include <vector>

#include "model/fit.hpp"

namespace remapc {

// Value at `x` (Horner's rule). No coefficients: 0.
double polynomial_value(const std::vector<double>& coefficients, double x);

std::vector<double> polynomial_derivative(const std::vector<double>& coefficients);

std::vector<double> polynomial_product(const std::vector<double>& a, const std::vector<double>& b);

// Lagrange's basis on `nodes`: the polynomial that is 1 at node `k` and 0 at the others.
std::vector<double> lagrange_polynomial(const std::vector<double>& nodes, std::size_t k);

// Where a polynomial is at least what it is nearby within a range, and its value there.
struct PolynomialMinimum {
  double at = 0.0;
  double value = 0.0;
};

// All local minima over `range`, ends included, least first; at least one. A parabola has its vertex, moved
// into the range.
std::vector<PolynomialMinimum> polynomial_minima(const std::vector<double>& coefficients,
                                                 const remap::Range& range);

}  // namespace remapc
