// This file describes how pictures of a model depend on its specular: by a law, or as combinations of a few
// pictures whose weights are polynomials. The loss of a match is then a polynomial, too.
#pragma once

#include <string_view>
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

// A SpecularLaw is the way in which pictures depend on a model's specular parameter. All laws except kOther
// have a canonical coordinate in which the picture is base + specular * slope.
enum class SpecularLaw {
  kProportional,  // specular * slope
  kAffine,        // base + specular * slope: F0 with Schlick's Fresnel
  kIor,           // affine in F0 = ((ior - 1) / (ior + 1))^2 (Sztrajman et al. 2019, equation 1)
  kClamped,       // base + specular * slope up to a knee, constant beyond
  kOther,         // no such law; the canonical coordinate is the parameter itself
};

// Returns `proportional`, `affine`, `ior`, `clamped` or `other`.
std::string_view law_name(SpecularLaw law);

struct SpecularResponse {
  SpecularLaw law = SpecularLaw::kOther;
  bool black_base = false;  // true if the picture is black at canonical specular 0
  double knee = 0.0;        // for kClamped, in the parameter's own unit
  double residual =
      0.0;  // largest deviation from the law, or for kOther from affine, relative to the brightest pixel

  bool affine() const { return law != SpecularLaw::kOther; }
  bool proportional() const { return affine() && black_base; }

  // Convert the parameter to the canonical coordinate, and a coordinate to the parameter. For kIor, the
  // coordinate is F0, otherwise the parameter itself.
  double canonical(double own) const;
  double native(double canonical) const;
};

// The following types describe how the pictures of a model at one width depend on specular, whatever its law.
// Every picture is a combination of a few pictures, and the weights are polynomials. So a match handles only
// polynomials.

// A SpecularCoordinate is the variable of the weight polynomials.
enum class SpecularCoordinate {
  kSpecular,  // canonical specular
  kEven,      // the range of canonical specular, mapped to -1 to 1
  kRoot,      // the root of the fraction of the range, mapped to -1 to 1; fits exact Fresnel
};

// A SpecularFamily gives pictures: picture(specular) = sum over k of weights[k](coordinate(specular)) *
// picture k.
struct SpecularFamily {
  Range range;  // canonical speculars for which the formula holds
  SpecularCoordinate coordinate_kind = SpecularCoordinate::kSpecular;
  std::vector<double> speculars;  // one for each picture; for an affine family, take_family() chooses
  std::vector<std::vector<double>> weights;  // one polynomial for each picture, with rising powers

  std::size_t picture_count() const { return weights.size(); }
  double coordinate(double specular) const;
  double specular(double coordinate) const;  // canonical, clamped to the range
  Range coordinate_range() const;

  // Returns the weights of the pictures at canonical `specular`, or their derivatives by it. A root has no
  // derivative at the lower end of the range, so the derivative at a point close to the end is returned.
  std::vector<double> weights_at(double specular) const;
  std::vector<double> slopes_at(double specular) const;
};

// Returns the family base + specular * slope. If the base is black, returns specular * slope.
SpecularFamily affine_family(const Range& range, bool black_base);

// Returns the sum of `pictures` times `weights`, in double precision to keep each pixel's relative precision.
std::vector<float> combined(const std::vector<std::vector<float>>& pictures,
                            const std::vector<double>& weights);

}  // namespace remap
