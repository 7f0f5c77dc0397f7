// Finds, from pictures alone, few pictures that all others of a model without a law are combinations of.
#pragma once

#include <optional>

#include "probe/specular_family.hpp"

namespace remapc {

class PictureTaker;
struct ModelDescription;

// The family of `model` (whose canonical specular is its own parameter) with as few pictures as serve at
// three widths within `alphas`: polynomials in specular, or in its root, of a degree up to 16 that give
// pictures between the probed ones to picture_tolerance. None where there is no such; 9 to 198 pictures.
std::optional<SpecularFamily> probe_family(const PictureTaker& picture_taker, const ModelDescription& model,
                                           const remap::Range& alphas);

}  // namespace remapc
