// Describes how the pictures of a model at one width depend on specular: as combinations of a few pictures
// whose weights are polynomials. A match therefore handles polynomials only, whatever the model does with
// specular.
#pragma once

#include <vector>

#include "remap/fit.hpp"

namespace remapc {

// The variable of the weight polynomials.
enum class SpecularCoordinate {
  kSpecular,  // canonical specular
  kEven,      // the range of canonical specular, mapped to -1 to 1
  kRoot,      // the root of the share of the range, mapped to -1 to 1; fits exact Fresnel
};

// Picture(specular) = sum over k of weights[k](coordinate(specular)) * picture k, at every width.
struct SpecularFamily {
  remap::Range range;  // canonical speculars for which it holds
  SpecularCoordinate coordinate_kind = SpecularCoordinate::kSpecular;
  std::vector<double> speculars;  // one for each picture; take_family chooses those of an affine family
  std::vector<std::vector<double>> weights;  // one polynomial for each picture, ascending powers

  std::size_t picture_count() const { return weights.size(); }
  double coordinate(double specular) const;
  double specular(double coordinate) const;  // canonical, clamped to the range
  remap::Range coordinate_range() const;

  // Returns the weights of the pictures at canonical `specular`, or their derivatives by it. At the lower end
  // of the range a root has no derivative; that of a point close by is returned.
  std::vector<double> weights_at(double specular) const;
  std::vector<double> slopes_at(double specular) const;
};

// Makes the family base + specular * slope, or specular * slope for a black base.
SpecularFamily affine_family(const remap::Range& range, bool black_base);

// Returns the sum of `pictures` times `weights`, in double precision to keep each pixel's relative precision.
std::vector<float> combined(const std::vector<std::vector<float>>& pictures,
                            const std::vector<double>& weights);

}  // namespace remapc
