#include "emit/slope_polynomial.hpp"

#include <cmath>
#include <numbers>

#include "model/interpreter.hpp"

namespace remapc {
namespace {

using remap::Parametric;
using remap::Range;

constexpr int kGridPoints = 20001;

double as_float(double value) { return static_cast<double>(static_cast<float>(value)); }

// Coefficients in u = alpha - centre of the polynomial through k at the Chebyshev nodes of the range
// (Newton's divided differences, then expanded).
std::vector<double> interpolate(const Parametric& form, const Range& alpha, double centre, int degree) {
  const int count = degree + 1;
  std::vector<double> nodes, differences;
  for (int i = 0; i < count; ++i) {
    const double node = 0.5 * (alpha.min + alpha.max) +
                        0.5 * (alpha.max - alpha.min) * std::cos((i + 0.5) * std::numbers::pi / count);
    nodes.push_back(node - centre);
    differences.push_back(remap::specular_slope(form, node));
  }
  for (std::size_t order = 1; order < nodes.size(); ++order)
    for (std::size_t i = nodes.size() - 1; i >= order; --i)
      differences[i] = (differences[i] - differences[i - 1]) / (nodes[i] - nodes[i - order]);
  std::vector<double> coefficients = {differences.back()};
  for (std::size_t i = nodes.size() - 1; i-- > 0;) {
    // coefficients * (u - nodes[i]) + differences[i]
    coefficients.insert(coefficients.begin(), 0.0);
    for (std::size_t j = 0; j + 1 < coefficients.size(); ++j)
      coefficients[j] -= nodes[i] * coefficients[j + 1];
    coefficients[0] += differences[i];
  }
  return coefficients;
}

double value(const std::vector<double>& coefficients, double u) {
  double sum = 0.0;
  for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * u + coefficients[i];
  return sum;
}

double derivative(const std::vector<double>& coefficients, double u) {
  double sum = 0.0;
  for (std::size_t i = coefficients.size(); i-- > 1;)
    sum = sum * u + static_cast<double>(i) * coefficients[i];
  return sum;
}

double slope_derivative(const Parametric& form, double alpha) {
  return form.ramp * std::exp(-form.ramp_rate * alpha) +
         form.bump * 2.0 * alpha * std::exp(-form.bump_rate * alpha * alpha);
}

// With e = P - k: |e| <= max on the grid + h/2 max|e'|, and |e'| <= max on the grid + h/2 max|e''|.
// |k''| <= |ramp| ramp_rate + 2 |bump|, since |(2 - 4 t) exp(-t)| <= 2 for t >= 0.
double proven_bound(const Parametric& form, const Range& alpha, const SlopePolynomial& polynomial) {
  const double reach = std::max(alpha.max - polynomial.centre, polynomial.centre - alpha.min);
  double second = std::fabs(form.ramp) * form.ramp_rate + 2.0 * std::fabs(form.bump);
  double power = 1.0;
  for (std::size_t i = 2; i < polynomial.coefficients.size(); ++i, power *= reach)
    second += static_cast<double>(i * (i - 1)) * std::fabs(polynomial.coefficients[i]) * power;

  const double step = (alpha.max - alpha.min) / (kGridPoints - 1);
  double largest = 0.0, steepest = 0.0;
  for (int i = 0; i < kGridPoints; ++i) {
    const double a = alpha.min + step * i, u = a - polynomial.centre;
    largest =
        std::max(largest, std::fabs(value(polynomial.coefficients, u) - remap::specular_slope(form, a)));
    steepest =
        std::max(steepest, std::fabs(derivative(polynomial.coefficients, u) - slope_derivative(form, a)));
  }
  return largest + 0.5 * step * (steepest + 0.5 * step * second);
}

}  // namespace

std::optional<SlopePolynomial> approximate_slope(const Parametric& form, const Range& alpha, double tolerance,
                                                 int max_degree) {
  SlopePolynomial polynomial;
  polynomial.centre = as_float(0.5 * (alpha.min + alpha.max));
  for (int degree = 1; degree <= max_degree; ++degree) {
    polynomial.coefficients = interpolate(form, alpha, polynomial.centre, degree);
    for (double& coefficient : polynomial.coefficients) coefficient = as_float(coefficient);
    polynomial.bound = proven_bound(form, alpha, polynomial);
    if (polynomial.bound <= tolerance) return polynomial;
  }
  return std::nullopt;
}

}  // namespace remapc
