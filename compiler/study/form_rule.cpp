#include "study/form_rule.hpp"

#include <algorithm>
#include <map>

namespace remap {

FormRule::FormRule(ShortForm form) : form_(std::move(form)), outputs_(outputs_of(form_)) {}

LobeSurface FormRule::operator()(const LobeMaterial& material) const {
  const bool has_exponent = form_.kind == ShortKind::kExponent || form_.kind == ShortKind::kExponentNormal;
  LobeSurface surface{0.0, {}, material.diffuse, has_exponent};
  for (std::size_t c = 0; c < 3; ++c) {
    const ShortTexel texel = converted(outputs_, form_.kind, material.alpha, material.specular[c]);
    surface.alpha = texel.alpha;
    surface.specular[c] = texel.specular;
  }
  if (!has_exponent) return surface;
  const double f = *std::ranges::max_element(surface.specular);
  std::map<std::string, double> inputs = {{"n", from_alpha(RoughnessConvention::kExponent, material.alpha)},
                                          {"f", f}};
  for (std::size_t c = 0; c < 3; ++c) {
    inputs["ks"] = material.specular[c];
    inputs["kd"] = material.diffuse[c];
    surface.diffuse[c] = outputs_[2].value.value(inputs) * (1.0 - f);
  }
  return surface;
}

}  // namespace remap
