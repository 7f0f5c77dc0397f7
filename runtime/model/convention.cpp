#include "remap/convention.hpp"

#include <cmath>

#include "text/named_values.hpp"

namespace remap {
namespace {

constexpr NamedValues<RoughnessConvention, 5> kConventions = {
    {{RoughnessConvention::kAlpha, "alpha"},
     {RoughnessConvention::kRoughness, "roughness"},
     {RoughnessConvention::kExponent, "exponent"},
     {RoughnessConvention::kGlossiness, "glossiness"},
     {RoughnessConvention::kSquared, "squared"}}};

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

std::string_view convention_name(RoughnessConvention convention) { return name_of(kConventions, convention); }

std::optional<RoughnessConvention> convention_from_name(std::string_view name) {
  return value_named(kConventions, name);
}

std::vector<std::string> convention_names() { return names_of(kConventions); }

}  // namespace remap
