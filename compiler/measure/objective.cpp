#include "measure/objective.hpp"

#include <algorithm>

#include "core/nearest_name.hpp"
#include "remap/error.hpp"

namespace remap {

Objective objective_preset(const std::string& name) {
  if (name == "natural") return {{Light{60.0, 3.0}}, Weighting::kRelative, 0.1};
  if (name == "paper") return {{Light{}}, Weighting::kUniform, 0.1};
  throw Error(ErrorKind::kUsage, "objective: unknown objective " + name + suggestion(name, kObjectives));
}

std::vector<float> squared_weights(const Objective& objective, std::span<const float> source,
                                   std::span<const float> view_cosines) {
  if (objective.weighting == Weighting::kUniform) return std::vector<float>(source.size(), 1.0f);
  std::vector<float> weights(source.size());
  const std::size_t pixels = view_cosines.size();
  for (std::size_t start = 0; start < source.size(); start += pixels) {
    const std::span<const float> picture = source.subspan(start, pixels);
    const double brightest = *std::max_element(picture.begin(), picture.end());
    const double scale = brightest > 0.0 ? 1.0 / brightest : 0.0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const double weight = view_cosines[i] / (picture[i] * scale + objective.floor);
      weights[start + i] = static_cast<float>(weight * weight);
    }
  }
  return weights;
}

}  // namespace remap
