#include "measure/objective.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {

Objective objective_preset(const std::string& name) {
  if (name == "natural-1") return {name, {Light{60.0, 3.0}}};
  if (name == "natural-2" || name == "natural")
    return {"natural-2", {Light{65.0, 3.0}}, Weighting::kRelative, 0.1, 5.0};
  if (name == "paper") return {name, {Light{}}, Weighting::kUniform};
  throw usage_error("objective: unknown objective " + name + suggestion(name, kObjectives));
}

Objective recorded_objective(const std::string& name) {
  return objective_preset(name == "natural" ? "natural-1" : name);
}

bool is_black(std::span<const float> picture) { return *std::ranges::max_element(picture) <= kBlackRadiance; }

PictureWeights squared_weights(const Objective& objective, std::span<const float> source,
                               std::span<const float> view_cosines) {
  if (objective.weighting == Weighting::kUniform) return {std::vector<float>(source.size(), 1.0f), {}};
  PictureWeights result;
  std::vector<float>& weights = result.squared;
  weights.reserve(source.size());
  const std::size_t pixels = view_cosines.size();
  while (weights.size() < source.size()) {
    const std::span<const float> picture = source.subspan(weights.size(), pixels);
    const double brightest = *std::ranges::max_element(picture);
    const double scale = brightest > 0.0 ? 1.0 / brightest : 0.0;
    double power = 0.0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const double value = picture[i];
      const double weight = view_cosines[i] / (value * scale + objective.floor);
      power += weight * weight * value * value;
      weights.push_back(static_cast<float>(weight * weight));
    }
    if (!objective.compares_means()) continue;
    const double mean = source[weights.size()];
    result.means.push_back(weights.size());
    weights.push_back(static_cast<float>(is_black(picture) ? objective.mean_share
                                                           : objective.mean_share * power / (mean * mean)));
  }
  return result;
}

}  // namespace remap
