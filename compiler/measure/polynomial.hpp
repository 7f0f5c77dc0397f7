// This file handles polynomials in one variable, as coefficients in ascending powers. The loss of a match is
// a polynomial in specular.
#pragma once

#include <vector>

#include "lower/fit.hpp"

namespace remap {

// Returns the value at `x`, by Horner's rule. Without coefficients, it is 0.
double polynomial_value(const std::vector<double>& coefficients, double x);

std::vector<double> polynomial_derivative(const std::vector<double>& coefficients);

std::vector<double> polynomial_product(const std::vector<double>& a, const std::vector<double>& b);

// Returns the Lagrange basis polynomial on `nodes` that is 1 at node `k` and 0 at the others.
std::vector<double> lagrange_polynomial(const std::vector<double>& nodes, std::size_t k);

// Returns the places of all local minima over `range`, including its ends. There is at least one, and the
// smallest value comes first. If the vertex of a parabola is out of the range, the closest end is used.
std::vector<double> polynomial_minima(const std::vector<double>& coefficients, const Range& range);

}  // namespace remap
