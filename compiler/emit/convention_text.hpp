// What the conventions of widths are called in generated headers.
#pragma once

#include "remap/converter.hpp"

namespace remap {

struct ConventionText {
  const char* meaning;  // for a comment
  const char* formula;  // of alpha, for people; empty where the parameter is alpha
};

inline ConventionText convention_text(RoughnessConvention convention) {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      break;
    case RoughnessConvention::kRoughness:
      return {"perceptual roughness, square root of the microfacet width, (0, 1]", "roughness^2"};
    case RoughnessConvention::kExponent:
      return {"Phong exponent, 2 / alpha^2 - 2 of the microfacet width, from 0", "sqrt(2 / (exponent + 2))"};
    case RoughnessConvention::kGlossiness:
      return {"1 - square root of the microfacet width, [0, 1)", "(1 - glossiness)^2"};
    case RoughnessConvention::kSquared:
      return {"square of the microfacet width, (0, 1]", "sqrt(squared)"};
  }
  return {"microfacet width, (0, 1]", ""};
}

}  // namespace remap
