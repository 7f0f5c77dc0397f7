// This file makes a small fit for tests that need any fit.
#pragma once

#include "lower/fit.hpp"

namespace remap {

inline Fit example_fit() {
  Fit fit;
  fit.id = "example_a_to_example_b";
  fit.source = {"example/a", RoughnessEncoding::kAlpha, "specular"};
  fit.target = {"example/b", RoughnessEncoding::kRoughness, "f0"};
  fit.domain = {{0.05, 1.0}, {0.0, 0.5}};
  fit.mapping = Parametric{{{1.04, -0.388, -0.332, 0.25}}, {{1, {0.9, -0.3, 0.5, 0.1, 3.0, 0.0}}}};
  fit.table = {"example.csv", std::string(64, '0'), {}};
  fit.tool_version = "0.1.0";
  return fit;
}

}  // namespace remap
