// This file holds conversion formulas that many programs use, as mappings that can be evaluated on a table.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lower/interpreter.hpp"

namespace remap {

struct Baseline {
  std::string name;
  std::string formula;  // formula as text, for users
  // Converts canonical coordinates, like evaluate_mapping(). It is empty if the formula does not apply.
  std::function<MappedTexel(double alpha, double specular)> map;
  std::string why_not;  // why the formula does not apply
};

// Returns all baselines for two models, in a fixed order. The roughness conventions of both models decide
// which of them apply. If a formula does not convert specular, specular is copied.
std::vector<Baseline> baselines(const ModelSide& source, const ModelSide& target);

}  // namespace remap
