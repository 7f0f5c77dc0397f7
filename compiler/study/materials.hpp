// The measured metals and dielectrics that the studies convert.
#pragma once

#include <array>
#include <span>

namespace remapc {

// Index of refraction eta + i k for red, green, blue (linear sRGB).
struct Conductor {
  const char* name;
  std::array<double, 3> eta;
  std::array<double, 3> k;
  const char* source;  // page of refractiveindex.info: shelf/book/author
};

struct Dielectric {
  const char* name;
  double ior;          // in visible light
  const char* source;  // page of refractiveindex.info, or author, year and title
};

std::span<const Conductor> measured_conductors();
std::span<const Dielectric> measured_dielectrics();

}  // namespace remapc
