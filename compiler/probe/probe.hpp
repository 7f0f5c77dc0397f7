// What a model does with its parameters, found from its pictures alone: the law of its specular parameter,
// whether diffuse adds to the rest, and how strong its light is against another renderer's.
#pragma once

#include "probe/picture_taker.hpp"
#include "probe/specular_response.hpp"

namespace remapc {

// Renders `model` at three widths within `alphas` and three values of specular over its whole range each; a
// few more where it is not affine. Throws kInput where the picture at full specular is black.
SpecularResponse probe_specular(const PictureTaker& picture_taker, const ModelDescription& model,
                                const remap::Range& alphas);

// Deviations of pixels up to this, relative to the brightest of a picture, come from the rounding of the
// pictures that a law is looked for in.
double picture_tolerance(const ModelDescription& model);

// Widths that a sweep is about, and the part of them in which the width changes the picture.
struct EffectiveWidths {
  remap::Range asked;
  remap::Range effective;
  bool whole() const { return effective.min == asked.min && effective.max == asked.max; }
};

// The part of `alphas` in which the width changes the picture: a renderer may hold smaller widths at a least
// one, or take them for a mirror, which shows nothing of a point light. Good to 0.2 %; 4 pictures, and some
// 25 more for an end that is held. Throws kInput where no width in `alphas` changes it.
EffectiveWidths probe_widths(const PictureTaker& picture_taker, const ModelDescription& model,
                             const remap::Range& alphas);

// Whether diffuse adds the same picture, in proportion, whatever the width and specular.
bool probe_diffuse(const PictureTaker& picture_taker, const ModelDescription& model,
                   const remap::Range& alphas);

// The factor between the diffuse parameters of two models that gives the same diffuse light, in least
// squares, and what is left then relative to the source (RMS). What the diffuse parameter adds to the picture
// is taken as the difference of two pictures, so a Fresnel rim does not count as diffuse. First stage of the
// two-stage match (section 3.1), and, as the ratio of diffuse-only pictures, what irradiance is matched by
// (section 4). A scale that pictures of floats cannot tell from 1 is 1.
struct DiffuseMatch {
  double scale = 1.0;
  double error = 0.0;
};
// Whether the light of two models can be compared so; where one has no diffuse parameter it counts as the
// same.
bool light_matched(const ModelDescription& source, const ModelDescription& target);

DiffuseMatch match_diffuse(const PictureTaker& picture_taker, const ModelDescription& source,
                           const ModelDescription& target);

}  // namespace remapc
