#include <cmath>

#include "remap/model.hpp"

namespace remap {

double to_alpha(RoughnessEncoding convention, double own) {
  switch (convention) {
    case RoughnessEncoding::kAlpha:
      return own;
    case RoughnessEncoding::kRoughness:
      return own * own;
    case RoughnessEncoding::kExponent:
      return std::sqrt(2.0 / (own + 2.0));
    case RoughnessEncoding::kGlossiness:
      return (1.0 - own) * (1.0 - own);
    case RoughnessEncoding::kSquared:
      return std::sqrt(own);
  }
  return own;
}

double from_alpha(RoughnessEncoding convention, double alpha) {
  switch (convention) {
    case RoughnessEncoding::kAlpha:
      return alpha;
    case RoughnessEncoding::kRoughness:
      return std::sqrt(alpha);
    case RoughnessEncoding::kExponent:
      return 2.0 / (alpha * alpha) - 2.0;
    case RoughnessEncoding::kGlossiness:
      return 1.0 - std::sqrt(alpha);
    case RoughnessEncoding::kSquared:
      return alpha * alpha;
  }
  return alpha;
}

}  // namespace remap
