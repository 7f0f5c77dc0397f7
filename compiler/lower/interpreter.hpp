// This file holds the reference interpreter, which evaluates a fit in double precision. Tests compare
// generated headers with it. Fits without a converter run in it.
#pragma once

#include <span>

#include "lower/fit.hpp"

namespace remap {

// Returns alpha and specular inside the domain, without the domain rule and without limits.
MappedTexel evaluate_mapping(const MappingKind& mapping, double alpha, double specular);

// Returns true if neither target parameter of a texel with one channel reaches its limit.
bool is_inside(const Fit& fit, double alpha, double specular);

// Returns both parameters of a texel with one channel, with the domain rule and limits.
MappedTexel evaluate_fit(const Fit& fit, double alpha, double specular);
// Evaluates a form like evaluate_fit(). A form has its own limits.
MappedTexel form_texel(const CompactForm& form, const Domain& domain, double alpha, double specular);

// Converts one texel with the domain rule, in the models' own parameters. `roughness` is the source's width
// parameter. `specular` has one linear value per channel, and `specular_out` as many. Returns the target's
// width parameter.
//
// Domain rule: target alpha is source alpha times a factor, and target specular is source specular times
// another factor. Beyond the domain the factors keep their values at its edge, and widths above it are
// clamped. Specular below 0 is treated as 0. The largest channel determines the alpha factor. At a limit of
// the target, the hinge of a compact form applies (converter/compact_form.hpp); other kinds have none. A
// texel with a value that is not finite is NaN in every output. `in_domain`, if given, receives whether the
// texel was inside the domain.
double evaluate_texel(const Fit& fit, double roughness, std::span<const double> specular,
                      std::span<double> specular_out, bool* in_domain = nullptr);

// Return the covered ranges of the source's own width parameter and of its specular, rounded to float.
// Generated headers use floats, so both agree on texels at the edge.
Range own_roughness_range(const Fit& fit);
Range specular_range(const Fit& fit);

}  // namespace remap
