// A fit whose conversion is known.
#pragma once

#include <string>

#include "model/fit.hpp"

namespace remapc {

// alpha2 = scale alpha1, specular2 = specular1.
inline remap::Fit scaled_fit(const std::string& source, const std::string& target, double scale) {
  remap::Fit fit;
  fit.id = "test";
  fit.source = {source, remap::RoughnessConvention::kAlpha, "f0"};
  fit.target = {target, remap::RoughnessConvention::kAlpha, "f0"};
  fit.domain = {{0.05, 1.0}, {0.0, 1.0}};
  fit.mapping = remap::Parametric{{{scale, 0.0, 0.0, 0.0}}, {{1, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0}}}};
  return fit;
}

}  // namespace remapc
