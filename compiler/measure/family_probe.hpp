// For a model without a known specular law, this file finds pictures whose combinations give all others.
#pragma once

#include <optional>

#include "measure/specular_response.hpp"

namespace remap {

class PictureTaker;
struct ModelDescription;

// Returns the family of `model` with the fewest pictures that suffice at three widths within `alphas`. The
// model's canonical specular must be its own parameter. Polynomials in specular or in its root, of degree 2,
// 4, 8 or 16, are tried until one reproduces the pictures between its nodes to picture_tolerance. Returns
// nothing if none does. Renders 9 to 198 pictures.
std::optional<SpecularFamily> probe_family(const PictureTaker& picture_taker, const ModelDescription& model,
                                           const Range& alphas);

}  // namespace remap
