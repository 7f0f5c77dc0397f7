// This file holds the conversion formulas in common use, as mappings that can be evaluated on a table.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lower/fit.hpp"
#include "lower/interpreter.hpp"

namespace remap {

struct Baseline {
  std::string name;
  std::string formula;  // shown to users
  // Converts canonical coordinates, like evaluate_mapping(). The function is empty if the formula does not
  // apply.
  std::function<MappedTexel(double alpha, double specular)> map;
  std::string why_not;  // why the formula does not apply
};

// Returns all baselines for two models in a fixed order. Whether one applies depends on the roughness
// conventions of both models. Specular is copied unless the formula converts it.
std::vector<Baseline> baselines(const ModelSide& source, const ModelSide& target);

}  // namespace remap
