#include "measure/specular_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/fresnel.hpp"

namespace remap {
namespace {

// This limits the steps of Newton's method. If a step would leave the bracket, the bracket is halved instead.
constexpr int kMostSteps = 100;

// Returns the zero of a polynomial between `low` and `high`. Its values there must have different signs.
double bracketed_root(const std::vector<double>& coefficients, const std::vector<double>& derivative,
                      double low, double high) {
  const bool rises = polynomial_value(coefficients, low) < 0.0;
  double x = 0.5 * (low + high);
  for (int step = 0; step < kMostSteps; ++step) {
    const double value = polynomial_value(coefficients, x);
    if (value == 0.0) return x;
    ((value < 0.0) == rises ? low : high) = x;
    const double newton = x - value / polynomial_value(derivative, x);
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == x || std::fabs(next - x) <= 1e-16 * std::fabs(x)) return next;
    x = next;
  }
  return x;
}

// Returns the zeros within `range` at which the sign changes, in rising order. Between two zeros of the
// derivative, there is at most one.
std::vector<double> roots(const std::vector<double>& coefficients, const Range& range) {
  if (coefficients.size() < 2) return {};
  const std::vector<double> derivative = polynomial_derivative(coefficients);
  std::vector<double> cuts = roots(derivative, range);
  cuts.insert(cuts.begin(), range.min);
  cuts.push_back(range.max);
  std::vector<double> found;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    if ((polynomial_value(coefficients, cuts[i]) < 0.0) !=
        (polynomial_value(coefficients, cuts[i + 1]) < 0.0))
      found.push_back(bracketed_root(coefficients, derivative, cuts[i], cuts[i + 1]));
  return found;
}

// Below this fraction of the range, the derivative by specular is the one at this fraction. A root has an
// infinite derivative at 0, where pictures made of roots contain only rounding errors.
constexpr double kLeastShare = 1e-4;

}  // namespace

double polynomial_value(const std::vector<double>& coefficients, double x) {
  double value = 0.0;
  for (std::size_t i = coefficients.size(); i-- > 0;) value = value * x + coefficients[i];
  return value;
}

std::vector<double> polynomial_derivative(const std::vector<double>& coefficients) {
  std::vector<double> derivative;
  for (std::size_t i = 1; i < coefficients.size(); ++i)
    derivative.push_back(static_cast<double>(i) * coefficients[i]);
  return derivative;
}

std::vector<double> polynomial_product(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || b.empty()) return {};
  std::vector<double> product(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  return product;
}

std::vector<double> lagrange_polynomial(const std::vector<double>& nodes, std::size_t k) {
  std::vector<double> basis = {1.0};
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    if (j == k) continue;
    const double scale = 1.0 / (nodes[k] - nodes[j]);
    basis = polynomial_product(basis, {-nodes[j] * scale, scale});
  }
  return basis;
}

std::vector<double> polynomial_minima(const std::vector<double>& coefficients, const Range& range) {
  if (coefficients.size() == 3 && coefficients[2] > 0.0)
    return {std::clamp(-coefficients[1] / (2.0 * coefficients[2]), range.min, range.max)};
  std::vector<double> points = roots(polynomial_derivative(coefficients), range);
  points.insert(points.begin(), range.min);
  points.push_back(range.max);
  const auto value = [&](double x) { return polynomial_value(coefficients, x); };
  std::vector<double> minima;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool left = i == 0 || value(points[i]) <= value(points[i - 1]);
    const bool right = i + 1 == points.size() || value(points[i]) <= value(points[i + 1]);
    if (left && right) minima.push_back(points[i]);
  }
  std::ranges::stable_sort(minima, {}, value);
  return minima;
}

std::string_view law_name(SpecularLaw law) {
  constexpr std::array<std::string_view, 5> kNames = {"proportional", "affine", "ior", "clamped", "other"};
  return kNames[static_cast<std::size_t>(law)];
}

double SpecularResponse::canonical(double own) const {
  return law == SpecularLaw::kIor ? normal_reflectance(own) : own;
}

double SpecularResponse::native(double canonical) const {
  return law == SpecularLaw::kIor ? ior_of_reflectance(canonical) : canonical;
}

double SpecularFamily::coordinate(double specular) const {
  if (coordinate_kind == SpecularCoordinate::kSpecular) return specular;
  const double share = std::clamp((specular - range.min) / (range.max - range.min), 0.0, 1.0);
  return 2.0 * (coordinate_kind == SpecularCoordinate::kRoot ? std::sqrt(share) : share) - 1.0;
}

double SpecularFamily::specular(double coordinate) const {
  if (coordinate_kind == SpecularCoordinate::kSpecular) return coordinate;
  const double along = 0.5 * (1.0 + coordinate);
  const double share = coordinate_kind == SpecularCoordinate::kRoot ? along * along : along;
  return std::clamp(range.min + share * (range.max - range.min), range.min, range.max);
}

Range SpecularFamily::coordinate_range() const {
  return coordinate_kind == SpecularCoordinate::kSpecular ? range : Range{-1.0, 1.0};
}

std::vector<double> SpecularFamily::weights_at(double specular) const {
  const double at = coordinate(specular);
  std::vector<double> values;
  for (const std::vector<double>& weight : weights) values.push_back(polynomial_value(weight, at));
  return values;
}

std::vector<double> SpecularFamily::slopes_at(double specular) const {
  double rise = 1.0;  // derivative of the coordinate by specular
  if (coordinate_kind != SpecularCoordinate::kSpecular) rise = 2.0 / (range.max - range.min);
  if (coordinate_kind == SpecularCoordinate::kRoot) {
    const double share = std::max(kLeastShare, (specular - range.min) / (range.max - range.min));
    specular = range.min + share * (range.max - range.min);
    rise *= 0.5 / std::sqrt(share);
  }
  const double at = coordinate(specular);
  std::vector<double> slopes;
  for (const std::vector<double>& weight : weights)
    slopes.push_back(rise * polynomial_value(polynomial_derivative(weight), at));
  return slopes;
}

SpecularFamily affine_family(const Range& range, bool black_base) {
  SpecularFamily family{range, SpecularCoordinate::kSpecular, {}, {{1.0}, {0.0, 1.0}}};
  if (black_base) family.weights.erase(family.weights.begin());
  return family;
}

std::vector<float> combined(const std::vector<std::vector<float>>& pictures,
                            const std::vector<double>& weights) {
  std::vector<double> sums(pictures.front().size());
  for (std::size_t k = 0; k < pictures.size(); ++k)
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += weights[k] * static_cast<double>(pictures[k][i]);
  return std::vector<float>(sums.begin(), sums.end());
}

}  // namespace remap
