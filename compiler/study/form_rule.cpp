#include "study/form_rule.hpp"

#include <algorithm>
#include <map>

#include "lower/interpreter.hpp"
#include "study/lobe_bank.hpp"

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

const Fit* fit_of(const std::vector<Fit>& fits, const ShortForm& form) {
  const std::string target = has_exponent(form.source) ? "mitsuba/ggx-plain" : form.target;
  const auto fit = std::ranges::find_if(fits, [&](const Fit& candidate) {
    return candidate.source.model == form.source && candidate.target.model == target;
  });
  return fit == fits.end() ? nullptr : &*fit;
}

LobeRule compiled_rule(const Fit& fit, const ShortForm& form) {
  return [&fit, own = FormRule(form)](const LobeMaterial& material) {
    LobeSurface surface = own(material);
    surface.alpha =
        to_alpha(fit.target.roughness, evaluate_texel(fit, from_alpha(fit.source.roughness, material.alpha),
                                                      material.specular, surface.specular));
    for (double& specular : surface.specular) specular = std::min(1.0, specular);
    surface.diffuse = material.diffuse;
    return surface;
  };
}

}  // namespace remap
