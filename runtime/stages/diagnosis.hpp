// The reliability of a metallic material that was made from a specular one.
#pragma once

#include <span>

#include "stages/conversion.hpp"

namespace remap {

// The diagnosis of one texel.
struct MetallicDiagnosis {
  // Square root of the remaining weighted squared error; 0 for an exact match. Pictures under natural light
  // differ by about 0.42 of it, as root mean square of display values.
  float residual = 0.0f;
  // Share of [0, 1] in which metallic, with the best base color for it, has a squared error within (1/255)^2
  // of the least one. Above 0.2 metallic is undetermined, without effect on the picture.
  float metallic_width = 0.0f;
  // Whether a parameter, or by more than half a step of 8 bits the base color of a channel, was outside [0,
  // 1].
  bool is_clamped = false;
};

// Diagnoses `result`, which any method may have made from `material`. Weights and errors are those of the
// projection without its prior. NaN in the texel gives {NaN, NaN, true}. Throws the errors of
// require_valid().
MetallicDiagnosis diagnose(const WorkflowConversion& conversion, const SpecularMaterial& material,
                           const MetallicMaterial& result);

// The F0 of dielectrics in maps, estimated as the F0 with the least residual.
struct DielectricF0 {
  double f0 = kCommonDielectricF0;
  double residual = 0.0;  // root mean square over the texels, at this F0
  // Whether the residual at a distance of 0.01 is at least twice as large. It is not if all texels are metal,
  // or if the maps do not follow any metallic material.
  bool is_certain = false;
};

// `materials`: texels of a map; some thousand from all its parts suffice, and those with NaN are skipped.
// `conversion` gives the conventions; its own F0 is not used. The diffuse convention must be known, because
// it does not show in the residual. F0 is searched in 0 to 0.12. Throws kInput if all texels have NaN.
DielectricF0 estimate_dielectric_f0(const WorkflowConversion& conversion,
                                    std::span<const SpecularMaterial> materials);

}  // namespace remap
