// How a BRDF model names its width: every convention is an exact, invertible function of alpha, the
// microfacet width in which sweeps and fits run.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

enum class RoughnessConvention {
  kAlpha,       // the microfacet width itself, (0, 1]
  kRoughness,   // perceptual roughness, sqrt(alpha) (Burley 2012; glTF 2.0; Cycles since Blender 2.80)
  kExponent,    // Phong exponent, 2 / alpha^2 - 2 (Walter et al. 2007, section 5.2)
  kGlossiness,  // 1 - sqrt(alpha)
  kSquared,     // alpha^2, the square that the formulas of microfacet distributions hold
};

// Own parameter to alpha and back, in double precision. Exact inverses of each other up to rounding on
// alpha in (0, 1]; the exponent of alpha = 0 is infinite.
double to_alpha(RoughnessConvention convention, double own);
double from_alpha(RoughnessConvention convention, double alpha);

// `alpha`, `roughness`, `exponent`, `glossiness`, `squared`: the word in fits and tables, and the name of the
// parameter in generated headers.
std::string_view convention_name(RoughnessConvention convention);
std::optional<RoughnessConvention> convention_from_name(std::string_view name);
std::vector<std::string> convention_names();

}  // namespace remap
