// A short form as a rule to be judged.
#pragma once

#include <vector>

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

}  // namespace remap
