// The law by which the pictures of a model depend on its specular parameter.
#pragma once

#include <string_view>

#include "remap/fit.hpp"

namespace remapc {

// How pictures depend on a model's specular parameter. All laws but kOther have a canonical coordinate in
// which the picture is base + specular * slope.
enum class SpecularLaw {
  kProportional,  // specular * slope
  kAffine,        // base + specular * slope: F0 with Schlick's Fresnel
  kIor,           // affine in F0 = ((ior - 1) / (ior + 1))^2 (Sztrajman et al. 2019, equation 1)
  kClamped,       // base + specular * slope up to a knee, constant beyond
  kOther,         // none of these; the canonical coordinate is the parameter itself
};

// `proportional`, `affine`, `ior`, `clamped`, `other`.
std::string_view law_name(SpecularLaw law);

struct SpecularResponse {
  SpecularLaw law = SpecularLaw::kOther;
  bool black_base = false;  // the picture is black where the canonical specular is 0
  double knee = 0.0;        // for kClamped, in the parameter's own unit
  double residual =
      0.0;  // largest deviation from the law (kOther: from affine), relative to the brightest pixel

  bool affine() const { return law != SpecularLaw::kOther; }
  bool proportional() const { return affine() && black_base; }

  // Converts the parameter to the canonical coordinate and back: F0 for kIor, else the parameter itself.
  double canonical(double own) const;
  double own(double canonical) const;
};

}  // namespace remapc
