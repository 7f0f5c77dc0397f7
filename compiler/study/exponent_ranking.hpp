// How far rules for exponents are from the source, by decade of the exponent.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lights/environment.hpp"
#include "lower/short_form.hpp"
#include "renderer/image.hpp"
#include "study/exponent_rules.hpp"
#include "study/short_forms.hpp"

namespace remap {

inline constexpr std::size_t kDecades = 4;  // from 1, 10, 100 and 1000

struct RankedRule {
  std::string name, formula;
  ShortFigures all;                         // of every material
  std::array<double, kDecades> rmse{};      // under environments, %
  std::array<double, kDecades> relative{};  // under the light, the median
  double opengl = 0.0;  // RMSE of the 24 materials of OpenGL, %; NaN for other lobes than theirs
};

struct LobeRanking {
  std::string lobe;  // `legacy/blinn-phong`
  std::vector<RankedRule>
      rules;  // by RMSE; the best possible parameters first, with the form's diffuse and with Kd kept
};

// Spheres of four materials of OpenGL under one environment: a row each, columns the source and
// `kShownRules`.
inline constexpr std::array<const char*, 7> kShownRules = {
    "short form",  "short form, core", "short form, core, wide", "trimesh, O3DE, Yocto/GL",
    "Blender OBJ", "obj2gltf",         "mujoco-usd until 2026"};
Image exponent_sheet(const Environment& environment, const SphereSampling& sampling, const ShortForm& form);

// The rules for the lobes of `forms`, by the materials and lights that judge short forms.
std::vector<LobeRanking> rank_exponent_rules(const ShortFormsOptions& options,
                                             const std::vector<ShortForm>& forms);

}  // namespace remap
