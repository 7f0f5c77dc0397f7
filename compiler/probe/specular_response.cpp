#include "probe/specular_response.hpp"

#include "renderer/fresnel.hpp"

namespace remapc {

std::string_view law_name(SpecularLaw law) {
  switch (law) {
    case SpecularLaw::kProportional:
      return "proportional";
    case SpecularLaw::kAffine:
      return "affine";
    case SpecularLaw::kIor:
      return "ior";
    case SpecularLaw::kClamped:
      return "clamped";
    case SpecularLaw::kOther:
      return "other";
  }
  return "other";
}

double SpecularResponse::canonical(double own) const {
  return law == SpecularLaw::kIor ? normal_reflectance(own) : own;
}

double SpecularResponse::own(double canonical) const {
  return law == SpecularLaw::kIor ? ior_of_reflectance(canonical) : canonical;
}

}  // namespace remapc
