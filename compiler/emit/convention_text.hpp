// This file gives the names of the encodings of widths in generated headers.
#pragma once

#include "remap/converter.hpp"

namespace remap {

struct ConventionText {
  const char* meaning;  // words for a comment in the header
  const char* formula;  // a formula of alpha for people; empty if the parameter is alpha itself
};

inline ConventionText convention_text(RoughnessEncoding convention) {
  switch (convention) {
    case RoughnessEncoding::kAlpha:
      break;
    case RoughnessEncoding::kRoughness:
      return {"perceptual roughness, square root of the microfacet width, (0, 1]", "roughness^2"};
    case RoughnessEncoding::kExponent:
      return {"Phong exponent, 2 / alpha^2 - 2 of the microfacet width, from 0", "sqrt(2 / (exponent + 2))"};
    case RoughnessEncoding::kGlossiness:
      return {"1 - square root of the microfacet width, [0, 1)", "(1 - glossiness)^2"};
    case RoughnessEncoding::kSquared:
      return {"square of the microfacet width, (0, 1]", "sqrt(squared)"};
  }
  return {"microfacet width, (0, 1]", ""};
}

}  // namespace remap
