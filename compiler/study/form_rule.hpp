// A short form, and the converter of its pair, as rules to be judged.
#pragma once

#include <vector>

#include "lower/fit.hpp"
#include "lower/short_form.hpp"
#include "study/rule_judge.hpp"

namespace remap {

// What a form gives, by its own lines. Exponents become glTF with KHR_materials_specular, whose diffuse is
// base color times 1 - F.
class FormRule {
 public:
  explicit FormRule(ShortForm form);
  LobeSurface operator()(const LobeMaterial& material) const;

 private:
  ShortForm form_;
  std::vector<ShortOutput> outputs_;
};

// The converter of the form's pair; null if there is none. Exponents become GGX with constant Fresnel, which
// the lobes have, too.
const Fit* fit_of(const std::vector<Fit>& fits, const ShortForm& form);

// What texels of the converter hold. Diffuse stays as it is, as texremap leaves it in specular workflows.
// `fit` must outlive it.
LobeRule compiled_rule(const Fit& fit, const ShortForm& form);

}  // namespace remap
