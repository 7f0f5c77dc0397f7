// This file makes a fit whose conversion is known.
#pragma once

#include <string>

#include "lower/fit.hpp"

namespace remap {

// Returns a fit with alpha2 = scale alpha1 and specular2 = specular1.
inline Fit scaled_fit(const std::string& source, const std::string& target, double scale) {
  Fit fit;
  fit.id = "test";
  fit.source = {source, RoughnessEncoding::kAlpha, "f0"};
  fit.target = {target, RoughnessEncoding::kAlpha, "f0"};
  fit.domain = {{0.05, 1.0}, {0.0, 1.0}};
  fit.mapping = Parametric{{{scale, 0.0, 0.0, 0.0}}, {{1, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0}}}};
  return fit;
}

}  // namespace remap
