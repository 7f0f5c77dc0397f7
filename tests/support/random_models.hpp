// Models that nobody would fit: random coefficients, vectors and layers over random domains, for properties
// that have to hold for every model.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

struct RandomModel {
  MappingKind mapping;
  Domain domain;
};

// Kinds: `parametric`, `svr`, `mlp`. The same seed gives the same model. Coefficients, rates, weights and
// widths spread over orders of magnitude; some domains are tiny, begin next to alpha 0 or at bright specular.
RandomModel random_model(const std::string& kind, std::uint64_t seed);
std::vector<std::string> random_kinds();

}  // namespace remap
