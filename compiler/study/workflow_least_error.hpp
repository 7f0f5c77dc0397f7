// What no conversion to the metallic workflow can do better: the base color and metallic whose pictures are
// nearest to those of a specular material, by numbers.
#pragma once

#include <cstddef>

#include "study/lit_reflectances.hpp"

namespace remapc {

// How a metallic material reflects (workflow/workflow.hpp): with n = 1 - metallic, diffuse_of_albedo n base
// color, and dielectric_f0 n + base color metallic.
struct MetallicReflection {
  double dielectric_f0 = 0.04;
  double diffuse_of_albedo = 1.0;
};

struct MetallicSurface {
  Rgb base_color{};
  double metallic = 0.0;
};

Reflectances reflectances_of(const MetallicSurface& surface, const MetallicReflection& reflection);

// Of least mean RMSE of display values over the environments of `lit` at one of its widths. Metallic is
// looked for on a grid of 33 values and by a golden section about the best; base color for each by Newton's
// method. Compares a quarter of the pixels, so that the pictures of the result may differ from the best by
// some thousandth of the RMSE.
MetallicSurface best_metallic(const LitReflectances& lit, std::size_t alpha, const Reflectances& source,
                              const MetallicReflection& reflection);

}  // namespace remapc
