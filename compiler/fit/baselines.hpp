// The formulas by which parameters are converted today, as mappings that a table can judge.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/fit.hpp"
#include "model/interpreter.hpp"

namespace remapc {

struct Baseline {
  std::string name;
  std::string formula;  // for people
  // In canonical coordinates, as evaluate_mapping(). Empty where the formula does not apply.
  std::function<remap::MappedTexel(double alpha, double specular)> map;
  std::string why_not;  // where it does not apply
};

// All of them for these two models, in a fixed order. What applies is decided by the conventions of the two
// widths. Specular is copied but where the formula says otherwise.
std::vector<Baseline> baselines(const remap::ModelSide& source, const remap::ModelSide& target);

}  // namespace remapc
