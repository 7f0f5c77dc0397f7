// What the conventions of widths are called in generated headers.
#pragma once

#include "remap/converter.hpp"

namespace remap {

// Roots are taken of whole rows (templates/roots.in), after the expression that gives alpha and before the
// one that takes it.
struct ConventionText {
  const char* meaning;  // for a comment
  const char* formula;  // of alpha, for people; empty where the parameter is alpha
  // An expression of `own`, the model's own parameter: alpha, or what alpha is the root of.
  const char* to_alpha;
  bool alpha_is_root;
  // An expression of `alpha`, which is the root of alpha where that is taken.
  const char* from_alpha;
  bool takes_root;
};

inline ConventionText convention_text(RoughnessConvention convention) {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      break;
    case RoughnessConvention::kRoughness:
      return {"perceptual roughness, square root of the microfacet width, (0, 1]",
              "roughness^2",
              "own * own",
              false,
              "alpha",
              true};
    case RoughnessConvention::kExponent:
      return {"Phong exponent, 2 / alpha^2 - 2 of the microfacet width, from 0",
              "sqrt(2 / (exponent + 2))",
              "2.0f / (own + 2.0f)",
              true,
              "2.0f / (alpha * alpha) - 2.0f",
              false};
    case RoughnessConvention::kGlossiness:
      return {"1 - square root of the microfacet width, [0, 1)",
              "(1 - glossiness)^2",
              "(1.0f - own) * (1.0f - own)",
              false,
              "1.0f - alpha",
              true};
    case RoughnessConvention::kSquared:
      return {"square of the microfacet width, (0, 1]", "sqrt(squared)", "own", true, "alpha * alpha", false};
  }
  return {"microfacet width, (0, 1]", "", "own", false, "alpha", false};
}

// Whether a header of the converter takes square roots.
inline bool takes_roots(const ConverterInfo& info) {
  return convention_text(info.source.roughness).alpha_is_root ||
         convention_text(info.target.roughness).takes_root;
}

}  // namespace remap
