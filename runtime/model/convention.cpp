#include "model/convention.hpp"

#include <array>
#include <cmath>

namespace remap {
namespace {

constexpr std::array kConventions = {RoughnessConvention::kAlpha, RoughnessConvention::kRoughness,
                                     RoughnessConvention::kExponent, RoughnessConvention::kGlossiness,
                                     RoughnessConvention::kSquared};

}  // namespace

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

std::string_view convention_name(RoughnessConvention convention) {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      return "alpha";
    case RoughnessConvention::kRoughness:
      return "roughness";
    case RoughnessConvention::kExponent:
      return "exponent";
    case RoughnessConvention::kGlossiness:
      return "glossiness";
    case RoughnessConvention::kSquared:
      return "squared";
  }
  return "alpha";
}

std::optional<RoughnessConvention> convention_from_name(std::string_view name) {
  for (const RoughnessConvention convention : kConventions)
    if (convention_name(convention) == name) return convention;
  return std::nullopt;
}

std::vector<std::string> convention_names() {
  std::vector<std::string> names;
  for (const RoughnessConvention convention : kConventions) names.emplace_back(convention_name(convention));
  return names;
}

}  // namespace remap
