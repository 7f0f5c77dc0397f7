// The least error of conversions to the metallic workflow: the base color and metallic whose pictures are
// nearest to those of a specular material, found by numerical search.
#pragma once

#include <cstddef>

#include "study/lit_reflectances.hpp"

namespace remapc {

// The reflectances of a metallic material (workflow/workflow.hpp). With n = 1 - metallic, diffuse reflectance
// is diffuse_of_albedo * n * base color, and F0 is dielectric_f0 * n + metallic * base color.
struct MetallicReflection {
  double dielectric_f0 = 0.04;
  double diffuse_of_albedo = 1.0;
};

struct MetallicSurface {
  Rgb base_color{};
  double metallic = 0.0;
};

Reflectances reflectances_of(const MetallicSurface& surface, const MetallicReflection& reflection);

// Returns the surface of least mean RMSE of display values over the environments of `lit` at one of its
// alphas. Searches metallic on a grid of 33 values and by a golden section around the best, and base color by
// Newton's method. Compares a quarter of the pixels, so that the RMSE may exceed the least by some
// thousandths of it.
MetallicSurface best_metallic(const LitReflectances& lit, std::size_t alpha, const Reflectances& source,
                              const MetallicReflection& reflection);

}  // namespace remapc
