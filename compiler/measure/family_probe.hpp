// This file finds a few pictures of a model whose combinations give all other pictures. It is for models
// without a known specular law.
#pragma once

#include <optional>

#include "measure/specular_response.hpp"

namespace remap {

class PictureTaker;
struct ModelDescription;

// Returns the family of `model` with the fewest pictures that suffice at three widths within `alphas`. The
// model's canonical specular must be its own parameter. Tries polynomials of degree 2, 4, 8 and 16, in
// specular and in its root. The first that reproduces the pictures between its nodes to picture_tolerance is
// used. Returns nothing if there is none. Renders 9 to 198 pictures.
std::optional<SpecularFamily> probe_family(const PictureTaker& picture_taker, const ModelDescription& model,
                                           const Range& alphas);

}  // namespace remap
