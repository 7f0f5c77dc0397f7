// The measured dielectrics that a study converts.
#pragma once

#include <span>

namespace remapc {

struct Dielectric {
  const char* name;
  double ior;          // in visible light
  const char* source;  // page of refractiveindex.info, or author, year and title
};

std::span<const Dielectric> measured_dielectrics();

}  // namespace remapc
