// What a metallic material cannot say of the specular one that it stands for.
#pragma once

#include <span>

#include "workflow/conversion.hpp"

namespace remap {

// Of one texel.
struct MetallicDiagnosis {
  // Square root of the weighted squared error that the conversion leaves; the difference of the pictures
  // under natural light is about 0.42 of it, as root mean square of display values. 0: an exact match.
  float residual = 0.0f;
  // Share of [0, 1] in which metallic could lie with a squared error within (1/255)^2 of the least,
  // each metallic with the base color that is best for it. Above 0.2 metallic is a guess on which the
  // picture does not depend.
  float metallic_width = 0.0f;
  // Whether a parameter was beyond 0 to 1, or a channel asks for a base color beyond it by more than half a
  // step of 8 bits.
  bool is_clamped = false;
};

// Of `result`, which any method may have made of `material`. Weights and errors are those of the projection;
// its prior has no part in them. All fields of a texel that holds NaN: NaN, NaN, true. Throws kInput as
// require_valid() does.
MetallicDiagnosis diagnose(const WorkflowConversion& conversion, const SpecularMaterial& material,
                           const MetallicMaterial& result);

// The F0 of a dielectric that maps were made with, estimated as that of least residual.
struct DielectricF0 {
  double f0 = kCommonDielectricF0;
  double residual = 0.0;  // root mean square over the texels, at this F0
  // Whether the residual 0.01 beside it is at least twice as large: texels that are all metal, or whose maps
  // follow no metallic material, do not tell.
  bool is_certain = false;
};

// `materials`: texels of a map, some thousand of all its parts are enough; those with NaN are passed over.
// `conversion` gives the conventions; its own F0 is not used. The diffuse convention cannot be told from the
// residual, so it must be known. F0 is looked for in 0 to 0.12. Throws kInput where no texel is left.
DielectricF0 estimate_dielectric_f0(const WorkflowConversion& conversion,
                                    std::span<const SpecularMaterial> materials);

}  // namespace remap
