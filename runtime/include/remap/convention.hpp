// The parameters by which BRDF models state the microfacet width. Each is an invertible function of alpha, in
// which sweeps and fits work.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "remap/named_values.hpp"

namespace remap {

enum class RoughnessConvention {
  kAlpha,       // the microfacet width itself, (0, 1]
  kRoughness,   // perceptual roughness, sqrt(alpha) (Burley 2012; glTF 2.0; Cycles since Blender 2.80)
  kExponent,    // Phong exponent, 2 / alpha^2 - 2 (Walter et al. 2007, section 5.2)
  kGlossiness,  // 1 - sqrt(alpha)
  kSquared,     // alpha^2, the square that the formulas of microfacet distributions hold
};

// Converts the model's own parameter to alpha and back. The functions are inverses up to rounding for alpha
// in (0, 1]; the exponent of alpha 0 is infinite.
double to_alpha(RoughnessConvention convention, double own);
double from_alpha(RoughnessConvention convention, double alpha);

// The names in fits and tables, and of the parameter in generated headers.
inline constexpr NamedValues<RoughnessConvention, 5> kConventions = {
    {{RoughnessConvention::kAlpha, "alpha"},
     {RoughnessConvention::kRoughness, "roughness"},
     {RoughnessConvention::kExponent, "exponent"},
     {RoughnessConvention::kGlossiness, "glossiness"},
     {RoughnessConvention::kSquared, "squared"}}};
inline std::string_view convention_name(RoughnessConvention convention) {
  return name_of(kConventions, convention);
}
inline std::optional<RoughnessConvention> convention_from_name(std::string_view name) {
  return value_named(kConventions, name);
}
inline std::vector<std::string> convention_names() { return names_of(kConventions); }

}  // namespace remap
