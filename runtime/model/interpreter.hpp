// The reference interpreter: a fit evaluated in double precision. It is the oracle that every generated
// header is tested against, and the way to apply a fit that has not been compiled.
#pragma once

#include <span>

#include "remap/fit.hpp"

namespace remap {

// The mapping inside its domain, in canonical coordinates. No domain rule.
MappedTexel evaluate_mapping(const MappingKind& mapping, double alpha, double specular);

// One texel with the domain rule, in the models' own parameters.
// `roughness`: source's own width parameter. `specular`: one linear value a channel; `specular_out`: as many.
// Returns the target's own width parameter. Rule (see fit.hpp, Domain): the width is clamped to the covered
// range; specular below 0 is held at 0; where a channel is beyond the covered specular range all channels are
// evaluated at the scale that brings the largest to the edge, and scaled back, so that chroma is kept. Target
// specular below 0 is held at 0: where a target's Fresnel outshines a dark source, the best is black. Target
// alpha is that of the largest channel. NaN in the width makes every output NaN; a channel that is NaN or
// infinite stays so, and the others do not see it. `in_domain`, if given, tells whether any of that was
// needed.
double evaluate_texel(const Fit& fit, double roughness, std::span<const double> specular,
                      std::span<double> specular_out, bool* in_domain = nullptr);

// The covered ranges of the source's own width parameter and of its specular, rounded to float: texels are
// floats, and generated headers and the interpreter must agree about the texel on the edge.
Range own_roughness_range(const Fit& fit);
Range specular_range(const Fit& fit);

}  // namespace remap
