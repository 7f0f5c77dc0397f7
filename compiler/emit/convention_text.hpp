// What the conventions of widths are called in generated headers.
#pragma once

#include "remap/converter.hpp"

namespace remap {

struct ConventionText {
  const char* meaning;  // for a comment
  const char* formula;  // of alpha, for people; empty where the parameter is alpha
  // Expressions of `own`, the model's own parameter, and of `alpha`. `root(x)` is the square root.
  const char* to_alpha;
  const char* from_alpha;
};

inline ConventionText convention_text(RoughnessConvention convention) {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      break;
    case RoughnessConvention::kRoughness:
      return {"perceptual roughness, square root of the microfacet width, (0, 1]", "roughness^2", "own * own",
              "root(alpha)"};
    case RoughnessConvention::kExponent:
      return {"Phong exponent, 2 / alpha^2 - 2 of the microfacet width, from 0", "sqrt(2 / (exponent + 2))",
              "root(2.0f / (own + 2.0f))", "2.0f / (alpha * alpha) - 2.0f"};
    case RoughnessConvention::kGlossiness:
      return {"1 - square root of the microfacet width, [0, 1)", "(1 - glossiness)^2",
              "(1.0f - own) * (1.0f - own)", "1.0f - root(alpha)"};
    case RoughnessConvention::kSquared:
      return {"square of the microfacet width, (0, 1]", "sqrt(squared)", "root(own)", "alpha * alpha"};
  }
  return {"microfacet width, (0, 1]", "", "own", "alpha"};
}

}  // namespace remap
