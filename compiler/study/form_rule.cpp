#include "study/form_rule.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace remap {
namespace {

constexpr double kLeastExponent = 0.1, kLargestExponent = 10000.0;

double largest_of(const Rgb& color) { return *std::ranges::max_element(color); }
double alpha_within(double alpha) { return std::isfinite(alpha) ? std::clamp(alpha, 1e-3, 1.0) : 1.0; }

}  // namespace

FormRule::FormRule(ShortForm form) : form_(std::move(form)), outputs_(outputs_of(form_)) {}

LobeSurface FormRule::operator()(const LobeMaterial& material) const {
  switch (form_.kind) {
    case ShortKind::kWidths:
      return widths(material);
    case ShortKind::kToExponent:
      return to_exponent(material);
    default:
      return exponent(material);
  }
}

LobeSurface FormRule::widths(const LobeMaterial& material) const {
  LobeSurface surface{0.0, {}, material.diffuse, false};
  std::map<std::string, double> inputs = {{"alpha", material.alpha}};
  surface.alpha = alpha_within(outputs_[0].value.value(inputs));
  for (std::size_t c = 0; c < 3; ++c) {
    inputs["specular"] = material.specular[c];
    surface.specular[c] = std::max(0.0, outputs_[1].value.value(inputs));
  }
  return surface;
}

LobeSurface FormRule::exponent(const LobeMaterial& material) const {
  LobeSurface surface{0.0, {}, {}, true};
  std::map<std::string, double> inputs = {{"n", from_alpha(RoughnessConvention::kExponent, material.alpha)}};
  const double roughness = outputs_[0].value.value(inputs);
  surface.alpha = alpha_within(roughness * roughness);
  for (std::size_t c = 0; c < 3; ++c) {
    inputs["ks"] = material.specular[c];
    surface.specular[c] = std::max(0.0, outputs_[1].value.value(inputs));
  }
  inputs["f"] = largest_of(surface.specular);
  for (std::size_t c = 0; c < 3; ++c) {
    inputs["ks"] = material.specular[c];
    inputs["kd"] = material.diffuse[c];
    surface.diffuse[c] = outputs_[2].value.value(inputs) * (1.0 - largest_of(surface.specular));
  }
  return surface;
}

LobeSurface FormRule::to_exponent(const LobeMaterial& material) const {
  LobeSurface surface{0.0, {}, material.diffuse, false};
  std::map<std::string, double> inputs = {{"roughness", std::sqrt(material.alpha)}};
  surface.alpha =
      alpha_within(to_alpha(RoughnessConvention::kExponent,
                            std::clamp(outputs_[0].value.value(inputs), kLeastExponent, kLargestExponent)));
  for (std::size_t c = 0; c < 3; ++c) {
    inputs["f0"] = material.specular[c];
    surface.specular[c] = std::max(0.0, outputs_[1].value.value(inputs));
  }
  return surface;
}

}  // namespace remap
