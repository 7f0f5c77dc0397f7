// Directions over which reflectances are compared.
#pragma once

#include <vector>

#include "renderer/brdf.hpp"

namespace remapc {

struct QuadratureDirection {
  // Of half vector and difference vector, in radians: 0 to pi / 2, 0 to pi / 2, 0 to pi.
  double half_angle = 0.0, difference_angle = 0.0, azimuth = 0.0;
  LocalGeometry geometry{};
  double weight =
      0.0;  // solid angles of both directions times the cosine of the light; up to one factor for all
};

// 349 pairs of directions in the coordinates of half and difference vector (Rusinkiewicz 1998), where
// highlights of any width are resolved: 20 angles of the half vector even in log(tan) from .004 to 86
// degrees, five Gauss nodes of the difference angle, five of its azimuth. Pairs with a cosine below .05 are
// left out.
std::vector<QuadratureDirection> half_vector_quadrature();

}  // namespace remapc
