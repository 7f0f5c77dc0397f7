// This file gives the directions at which reflectances are compared, and reads measured BRDFs at them.
#pragma once

#include <filesystem>
#include <vector>

#include "look/brdf.hpp"

namespace remap {

struct QuadratureDirection {
  // Angles of the half vector and of the difference vector are in radians. They are 0 to pi / 2, 0 to pi / 2,
  // and 0 to pi.
  double half_angle = 0.0, difference_angle = 0.0, azimuth = 0.0;
  LocalGeometry geometry{};
  double weight =
      0.0;  // solid angles of both directions times the cosine of the light, apart from a constant factor
};

// Returns 349 pairs of directions in coordinates of half and difference vector (Rusinkiewicz 1998), which
// resolve highlights of any width. They use 20 half angles, uniform in log(tan) from 0.004 to 86 degrees,
// five Gauss nodes of the difference angle and five of its azimuth. Pairs with a cosine below 0.05 are
// excluded.
std::vector<QuadratureDirection> half_vector_quadrature();

// Returns the reflectance of a MERL file at these directions, channel by channel. Cells that were not
// measured are 0. Throws kInput.
std::vector<float> read_merl(const std::filesystem::path& file);

}  // namespace remap
