// This file makes models that nobody would fit: random coefficients, vectors and layers over random domains.
// They test properties that must hold for every model.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

struct RandomModel {
  MappingKind mapping;
  Domain domain;
};

// Returns a random model. Kinds are `parametric`, `svr`, `mlp`. The same seed gives the same model.
// Coefficients, rates, weights and widths spread over orders of magnitude. Some domains are tiny, begin next
// to alpha 0 or at bright specular.
RandomModel random_model(const std::string& kind, std::uint64_t seed);
std::vector<std::string> random_kinds();

// Returns a fit of a compact form: any number of terms, with and without limits and hinges. Returns nothing
// if the form is not sound over its domain.
std::optional<Fit> random_form_fit(std::uint64_t seed);

// Returns a factor in float arithmetic, in the order of operations of generated headers.
float factor_in_floats(const FactorTerms& factor, float alpha, float t);

}  // namespace remap
