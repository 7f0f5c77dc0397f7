// How the pictures of a model at one width depend on specular: combinations of a few of them, whose weights
// are polynomials. Whatever a model does with its specular parameter, a match then meets polynomials only.
#pragma once

#include <vector>

#include "model/fit.hpp"

namespace remapc {

// In what the weights are polynomials.
enum class SpecularCoordinate {
  kSpecular,  // canonical specular as it is
  kEven,      // the range of canonical specular as -1 to 1
  kRoot,  // the same of the root of its share of the range: exact Fresnel, and what else goes with an index
};

// Picture(specular) = sum over k of weights[k](coordinate(specular)) * picture k, at every width.
struct SpecularFamily {
  remap::Range range;  // canonical speculars that it answers for
  SpecularCoordinate coordinate_kind = SpecularCoordinate::kSpecular;
  std::vector<double> speculars;  // where the pictures are taken; of an affine family see take_family
  std::vector<std::vector<double>> weights;  // one polynomial a picture, ascending powers

  std::size_t picture_count() const { return weights.size(); }
  double coordinate(double specular) const;
  double specular(double coordinate) const;  // canonical, within the range
  remap::Range coordinate_range() const;

  // The weights of the pictures at canonical `specular`, and their derivatives by it. At the lower end of a
  // root's range, where it has none, the derivative is that of a point close by.
  std::vector<double> weights_at(double specular) const;
  std::vector<double> slopes_at(double specular) const;
};

// base + specular * slope, or specular * slope where the base is black.
SpecularFamily affine_family(const remap::Range& range, bool black_base);

// The sum of `pictures` times `weights`, in double precision: it keeps the relative precision of each pixel.
std::vector<float> combined(const std::vector<std::vector<float>>& pictures,
                            const std::vector<double>& weights);

}  // namespace remapc
