#include "probe/objective.hpp"

#include <algorithm>

#include "remap/error.hpp"
#include "text/nearest_name.hpp"
#include "text/number_text.hpp"

namespace remapc {

using remap::Error;
using remap::ErrorKind;

Objective objective_preset(const std::string& name) {
  if (name == "natural") return {{Light{60.0, 3.0}}, Weighting::kRelative, 0.1};
  if (name == "paper") return {{Light{}}, Weighting::kUniform, 0.1};
  const std::vector<std::string> known = {"natural", "paper"};
  throw Error(ErrorKind::kUsage, "objective: unknown objective " + name + remap::suggestion(name, known));
}

Weighting weighting_from_name(const std::string& name) {
  if (name == "uniform") return Weighting::kUniform;
  if (name == "relative") return Weighting::kRelative;
  const std::vector<std::string> known = {"uniform", "relative"};
  throw Error(ErrorKind::kUsage, "weighting: unknown weighting " + name + remap::suggestion(name, known));
}

std::string weighting_name(Weighting weighting) {
  return weighting == Weighting::kUniform ? "uniform" : "relative";
}

std::vector<Light> parse_lights(const std::string& text, double distance) {
  std::vector<Light> lights;
  std::size_t start = 0;
  while (start <= text.size()) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string item = text.substr(start, end - start);
    const auto angle = item == "headlight" ? std::optional<double>(0.0) : remap::parse_number(item);
    if (!angle || !(*angle > -180.0 && *angle <= 180.0))
      throw Error(ErrorKind::kUsage,
                  "light: unknown light \"" + item + "\" (choose headlight or degrees from -180 to 180)");
    lights.push_back({*angle, distance});
    start = end + 1;
  }
  return lights;
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

}  // namespace remapc
