// What the conventions of widths are called in generated headers.
#pragma once

#include "remap/model.hpp"

namespace remap {

struct ConventionText {
  const char* meaning;     // for a comment
  const char* to_alpha;    // an expression of `own`, the model's own parameter
  const char* from_alpha;  // an expression of `alpha`
  const char* formula;     // of alpha, for people; empty where the parameter is alpha
};

inline ConventionText convention_text(RoughnessConvention convention) {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      break;
    case RoughnessConvention::kRoughness:
      return {"perceptual roughness, square root of the microfacet width, (0, 1]", "own * own",
              "std::sqrt(alpha)", "roughness^2"};
    case RoughnessConvention::kExponent:
      return {"Phong exponent, 2 / alpha^2 - 2 of the microfacet width, from 0",
              "std::sqrt(2.0f / (own + 2.0f))", "2.0f / (alpha * alpha) - 2.0f", "sqrt(2 / (exponent + 2))"};
    case RoughnessConvention::kGlossiness:
      return {"1 - square root of the microfacet width, [0, 1)", "(1.0f - own) * (1.0f - own)",
              "1.0f - std::sqrt(alpha)", "(1 - glossiness)^2"};
    case RoughnessConvention::kSquared:
      return {"square of the microfacet width, (0, 1]", "std::sqrt(own)", "alpha * alpha", "sqrt(squared)"};
  }
  return {"microfacet width, (0, 1]", "own", "alpha", ""};
}

}  // namespace remap
