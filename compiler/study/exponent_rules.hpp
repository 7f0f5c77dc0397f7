// Ranks the rules by which programs turn exponents into roughness, by the pictures of what they give.
#pragma once

#include <string>
#include <vector>

#include "study/rule_judge.hpp"

namespace remap {

// What a rule writes beside roughness.
enum class RuleStrength {
  kGlass,      // F0 0.04, metallic 0, base color Kd
  kCopied,     // F0 Ks, base color Kd
  kBlender,    // F0 0.08 mean(Ks), base color Kd
  kHalfMetal,  // metallic 0.4 of Kd (FBX2glTF)
  kShortForm,  // F0 and base color of the short form, constant Fresnel
  kCore,       // the same as base color and metallic of core glTF
  kCoreWide,   // the same, wider where the highlight would be too strong
};

struct ExponentRule {
  std::string name, formula;
  RuleStrength strength = RuleStrength::kGlass;
  double (*roughness)(double exponent, double luma) = nullptr;  // null: that of the short form
};

// The rules of importers and exporters, of which each is named by who uses it, and those of this project.
std::vector<ExponentRule> exponent_rules();

// The rule for lobes with these short forms; `form` must outlive it.
LobeRule rule_of(const ExponentRule& rule, const ShortForm& form);

// The 24 materials of the OpenGL courses (teapots.c of the OpenGL Programming Guide), as lobes of an
// exponent.
std::vector<LobeMaterial> opengl_materials();

}  // namespace remap
