// This file estimates the F0 of dielectrics from maps in the specular workflow.
#pragma once

#include <array>
#include <span>

#include "remap/workflow.hpp"
#include "stages/workflow_conventions.hpp"

namespace remap {

// A SpecularMaterial is one texel. Colors are linear, values 0 to 1. `width` is the workflow's width
// parameter.
struct SpecularMaterial {
  std::array<float, 3> diffuse{}, specular{};
  float width = 0.0f;
};

// Returns the texel in the form that the projection reads.
workflow_code::Texel texel_of(const workflow_code::Conventions& use, const SpecularMaterial& material);
bool has_nan(const SpecularMaterial& material);

// A DielectricF0 is the F0 of dielectrics that leaves the smallest residual in the maps.
struct DielectricF0 {
  double f0 = kCommonDielectricF0;
  double residual = 0.0;  // root mean square over the texels, at this F0
  // True if an F0 that differs by 0.01 at least doubles the residual. It is false if all texels are metal, or
  // if the maps do not follow any metallic material.
  bool is_certain = false;
};

// Estimates the F0. `materials` are a few thousand texels from all parts of the maps; texels with NaN are
// skipped. The workflows give the conventions, but the F0 of `metallic` is not used. The diffuse convention
// must be known, because the residual does not show it. The F0 is searched from 0 to 0.12. Throws kInput if
// all texels have NaN.
DielectricF0 estimate_dielectric_f0(const SpecularWorkflow& specular, const MetallicWorkflow& metallic,
                                    std::span<const SpecularMaterial> materials);

}  // namespace remap
