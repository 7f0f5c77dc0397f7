#include "measure/specular_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "measure/polynomial.hpp"
#include "renderer/fresnel.hpp"

namespace remap {

namespace {

// Below this fraction of the range, the derivative by specular is the one at this fraction. A root has an
// infinite derivative at 0, where pictures made of roots contain only rounding errors.
constexpr double kLeastShare = 1e-4;

}  // namespace

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
