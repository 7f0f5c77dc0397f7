// This file converts materials from before microfacets (Wavefront MTL, OpenGL, Collada) to GGX materials. It
// uses two formulas with five constants, chosen by pictures under lights and environments
// (docs/decisions/060-short-forms.md). The exponent decides the width of the highlight. It also decides its
// strength, because an unnormalised lobe has energy proportional to 1 / exponent.
#pragma once

#include <algorithm>
#include <array>

#include "assets/maps/workflow_values.hpp"

namespace remap {

// A LegacyMaterial has radiance = diffuse N.L + specular (N.H)^exponent, without a cosine or a norm on the
// lobe. This is unnormalised Blinn, illum 2 in the MTL specification (Alias|Wavefront 1995). Colors are
// linear, 0 to 1.
struct LegacyMaterial {
  std::array<double, 3> diffuse{}, specular{};
  double exponent = kLeastExponent;

  bool has_highlight() const noexcept {
    return std::ranges::any_of(specular, [](double value) { return value > 0.0; });
  }

  // The constants were measured for this range. The specification allows 0 to 1000.
  static constexpr double kLeastExponent = 1.0, kMostExponent = 10000.0;
};

// Return the lobe of the material as GGX: glTF's roughness (1.55 / (n + 4.17))^(1/4), and F0 = min(1, 6.02
// specular / (n + 1.86)), which does not change with the angle.
double ggx_roughness(const LegacyMaterial& material);
std::array<double, 3> ggx_f0(const LegacyMaterial& material);

// Returns base color and metallic of core glTF that keep the sum of diffuse and specular:
//   fraction of the dielectric f = min(1, 2 D / (S + D + sqrt((S + D)^2 - .16 D))), base = d + F0 - .04 f.
// D and S are the means of diffuse and F0 over channels, and .04 is the F0 of a dielectric. A material
// without a highlight gets base color = diffuse and roughness 1. Core cannot remove the F0 of .04. At
// roughness 1 this F0 adds about as much light as the diffuse lobe loses, so bright colors stay.
MetalRoughFactors core_of_legacy(const LegacyMaterial& material);

// A LegacyDielectric is glTF with KHR_materials_specular: metallic 0, and a specular whose F90 equals the
// largest F0, because the source has no Fresnel effect.
struct LegacyDielectric {
  std::array<double, 3> base_color{};  // min(1, diffuse / (1 - specular)), 0 to 1
  double specular = 0.0;               // specularFactor: the largest F0, 0 to 1
  // F0 / specular, 0 to 1. specularColorFactor is kDielectricScale * specular_color.
  std::array<double, 3> specular_color{};
  double roughness = 1.0;
};
inline constexpr double kDielectricScale = 25.0;  // 1 / .04

LegacyDielectric dielectric_of_legacy(const LegacyMaterial& material);

}  // namespace remap
