// The reference interpreter: evaluates a fit in double precision. Generated headers are tested against it,
// and fits that cannot be lowered run in it.
#pragma once

#include <span>

#include "lower/fit.hpp"

namespace remap {

// Alpha and specular inside the domain, without the domain rule and without limits.
MappedTexel evaluate_mapping(const MappingKind& mapping, double alpha, double specular);

// Whether neither target parameter reaches its limit. A texel of one channel.
bool is_inside(const Fit& fit, double alpha, double specular);

// Both, of a texel of one channel, with the domain rule and limits.
MappedTexel evaluate_fit(const Fit& fit, double alpha, double specular);
// The same of a form whose limits are its own.
MappedTexel form_texel(const CompactForm& form, const Domain& domain, double alpha, double specular);

// One texel with the domain rule, in the models' own parameters. `roughness`: the source's width parameter.
// `specular`: one linear value per channel; `specular_out`: as many. Returns the target's width parameter.
//
// The domain rule: target alpha is source alpha times a factor, and target specular source specular times
// another. Beyond the domain the factors are those at its edge, and widths above it are clamped. Specular
// below 0 counts as 0. The alpha factor is that of the largest channel. At a limit of the target, the hinge
// of a compact form applies (converter/compact_form.hpp), to other kinds none. A texel with a value that is
// not finite is NaN in every output. `in_domain`, if given, receives whether the texel was inside the domain.
double evaluate_texel(const Fit& fit, double roughness, std::span<const double> specular,
                      std::span<double> specular_out, bool* in_domain = nullptr);

// The covered ranges of the source's own width parameter and of its specular, rounded to float, so that
// generated headers and the interpreter agree on texels at the edge.
Range own_roughness_range(const Fit& fit);
Range specular_range(const Fit& fit);

}  // namespace remap
