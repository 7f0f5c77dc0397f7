// The reference interpreter: evaluates a fit in double precision. Generated headers are tested against it,
// and fits that cannot be lowered run in it.
#pragma once

#include <span>

#include "lower/fit.hpp"

namespace remap {

// Alpha and specular inside the domain, without the domain rule and without limits.
MappedTexel evaluate_mapping(const MappingKind& mapping, double alpha, double specular);

// Target alpha of a texel whose largest channel is `top`, without the domain rule.
struct TexelWidth {
  double alpha = 0.0;
  // The shares of the regimes that take over, 0 to 1: of the wide one in specular, of the bright one in
  // alpha.
  double wide = 0.0, bright = 0.0;
};
TexelWidth target_width(const Fit& fit, double alpha, double top);

// Target specular of a channel of such a texel, from 0 to the limit.
double target_channel(const Fit& fit, double wide, double alpha, double specular);

// Whether the mapping alone answers: neither target parameter reaches its limit. A texel of one channel.
bool is_inside(const Fit& fit, double alpha, double specular);

// The part of the domain in which the mapping is evaluated; beyond, it is clamped.
Domain mapping_domain(const Fit& fit);

// Both, of a texel of one channel.
MappedTexel evaluate_fit(const Fit& fit, double alpha, double specular);

// One texel with the domain rule, in the models' own parameters. `roughness`: the source's width parameter.
// `specular`: one linear value per channel; `specular_out`: as many. Returns the target's width parameter.
//
// The domain rule: the width is clamped to the covered range, and specular below 0 to 0. If a channel exceeds
// the covered specular range, all channels are scaled so that the largest lies on the edge, evaluated and
// scaled back, which keeps chroma. Target specular below 0 becomes 0: a target with a strong Fresnel effect
// matches a dark source best by black. Target alpha and the regime (regimes.hpp) are those of the largest
// channel. NaN in the width makes every output NaN. A channel that is NaN or infinite stays so and does not
// affect the others. `in_domain`, if given, receives whether the texel was inside the domain.
double evaluate_texel(const Fit& fit, double roughness, std::span<const double> specular,
                      std::span<double> specular_out, bool* in_domain = nullptr);

// The covered ranges of the source's own width parameter and of its specular, rounded to float, so that
// generated headers and the interpreter agree on texels at the edge.
Range own_roughness_range(const Fit& fit);
Range specular_range(const Fit& fit);

}  // namespace remap
