// This file gives the meaning of the encodings of widths in generated headers.
#pragma once

#include "remap/converter.hpp"

namespace remap {

// Returns words for a comment in the header.
inline const char* meaning_of(RoughnessEncoding encoding) {
  switch (encoding) {
    case RoughnessEncoding::kAlpha:
      break;
    case RoughnessEncoding::kRoughness:
      return "perceptual roughness, square root of the microfacet width, (0, 1]";
    case RoughnessEncoding::kExponent:
      return "Phong exponent, 2 / alpha^2 - 2 of the microfacet width, from 0";
    case RoughnessEncoding::kGlossiness:
      return "1 - square root of the microfacet width, [0, 1)";
    case RoughnessEncoding::kSquared:
      return "square of the microfacet width, (0, 1]";
  }
  return "microfacet width, (0, 1]";
}

}  // namespace remap
