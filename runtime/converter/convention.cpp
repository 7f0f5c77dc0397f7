#include <cmath>

#include "remap/model.hpp"

namespace remap {

double to_alpha(RoughnessConvention convention, double own) {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      return own;
    case RoughnessConvention::kRoughness:
      return own * own;
    case RoughnessConvention::kExponent:
      return std::sqrt(2.0 / (own + 2.0));
    case RoughnessConvention::kGlossiness:
      return (1.0 - own) * (1.0 - own);
    case RoughnessConvention::kSquared:
      return std::sqrt(own);
  }
  return own;
}

double from_alpha(RoughnessConvention convention, double alpha) {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      return alpha;
    case RoughnessConvention::kRoughness:
      return std::sqrt(alpha);
    case RoughnessConvention::kExponent:
      return 2.0 / (alpha * alpha) - 2.0;
    case RoughnessConvention::kGlossiness:
      return 1.0 - std::sqrt(alpha);
    case RoughnessConvention::kSquared:
      return alpha * alpha;
  }
  return alpha;
}

}  // namespace remap
