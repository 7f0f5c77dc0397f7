// This file finds out from a model's pictures what its parameters do. It finds the law of specular, the few
// pictures whose combinations give all others, whether diffuse adds to the highlight, and how strong the
// model's light is relative to another renderer's.
#pragma once

#include <optional>

#include "measure/picture_taker.hpp"
#include "measure/specular_response.hpp"

namespace remap {

// Renders `model` at three widths within `alphas`. Renders three values over the whole range of specular at
// each width, and a few more if the model is not affine. Throws kInput if the picture at full specular is
// black.
SpecularResponse probe_specular(const PictureTaker& picture_taker, const ModelDescription& model,
                                const Range& alphas);

// Returns how far rounding can move a pixel, relative to the brightest pixel of its picture. Larger
// deviations contradict a law.
double picture_tolerance(const ModelDescription& model);

// Finds the part of `alphas` in which the width changes the picture. Renderers may clamp smaller widths, or
// treat them as a mirror, which shows no point light. The result is accurate to 0.2 %. Renders 4 pictures,
// and about 25 more for each end that is clamped. Throws kInput if no width in `alphas` changes the picture.
Range probe_widths(const PictureTaker& picture_taker, const ModelDescription& model, const Range& alphas);

// Returns true if diffuse adds the same picture, in proportion, at every width and specular.
bool probe_diffuse(const PictureTaker& picture_taker, const ModelDescription& model, const Range& alphas);

// A DiffuseMatch holds the factor between the diffuse parameters of two models that gives the same diffuse
// light, by least squares. It also holds the RMS of the remaining difference, relative to the source. The
// diffuse picture is the difference of two pictures, so it does not contain the Fresnel rim. This match is
// the first stage of the two-stage match (section 3.1), and its ratio also matches the irradiance (section
// 4). A scale is 1 if float pictures cannot distinguish it from 1.
struct DiffuseMatch {
  double scale = 1.0;
  double error = 0.0;
};
// Returns true if match_diffuse() can compare the light of two models. If one of them has no diffuse
// parameter, remapc assumes equal light.
bool light_matched(const ModelDescription& source, const ModelDescription& target);

DiffuseMatch match_diffuse(const PictureTaker& picture_taker, const ModelDescription& source,
                           const ModelDescription& target);

// Returns the family of `model` with the fewest pictures that suffice at three widths within `alphas`. The
// model's canonical specular must be its own parameter. Tries polynomials of degree 2, 4, 8 and 16, in
// specular and in its root. The first that reproduces the pictures between its nodes to picture_tolerance is
// used. Returns nothing if there is none. Renders 9 to 198 pictures.
std::optional<SpecularFamily> probe_family(const PictureTaker& picture_taker, const ModelDescription& model,
                                           const Range& alphas);

}  // namespace remap
