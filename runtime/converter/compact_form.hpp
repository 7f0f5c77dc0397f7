// This file holds the form of every converter of width and specular: two factors of few terms, and a hinge
// that acts if the target model is at a limit.
//
//   t  = s / (s + pole)                          s: source specular, a: source alpha
//   A  = a P(a, t of the largest channel)        P, Q: sums of products t^j a^i
//   u  = s Q(a, t)                               for each channel
//   x  = max(0, largest u / specular limit - 1)
//   a2 = min(alpha limit,    A + a (turn + turn_by_alpha a) x / (1 + bend x))
//   s2 = min(specular limit, u (1 + spread max(0, A / alpha limit - 1)))
//
// A texel beyond the domain gets the factors of the closest texel in the domain, so that 0 stays 0 and both
// parameters continue in proportion. Source widths wider than the domain are clamped to its end.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "remap/model.hpp"

namespace remap {

// These are the most powers of t and of alpha, including power 0.
inline constexpr std::size_t kMostPowersOfT = 16, kMostPowersOfAlpha = 32;

// The indices are [power of t][power of alpha]. There is at least one row, and no row is empty.
using FactorTerms = std::vector<std::vector<float>>;

struct Hinge {
  float turn = 0.0f, turn_by_alpha = 0.0f;  // turn alpha if the limit of specular is exceeded
  float bend = 0.0f;    // at least 0; reduces the turn where the limit is exceeded by much
  float spread = 0.0f;  // spreads specular if the limit of alpha is exceeded
  bool operator==(const Hinge&) const = default;
};

struct CompactForm {
  float pole = 1.0f;  // above 0
  FactorTerms alpha = {{1.0f}}, specular = {{1.0f}};
  std::optional<float> alpha_limit, specular_limit;  // limits of the target, above 0; unset if it has none
  Hinge hinge;                                       // 0 without limits
  bool operator==(const CompactForm&) const = default;
};

// Returns true if alpha and specular stay unchanged, because both models have one lobe.
bool is_copy(const CompactForm& form);

// Returns how many numbers P, Q, the pole and the hinge have. Returns 0 for a copy. Limits do not count,
// because they belong to the target model.
std::size_t number_count(const CompactForm& form);

// Returns the value of a factor. `Scalar` is double, or a type that adds and multiplies with doubles.
template <typename Scalar>
Scalar factor_value(const FactorTerms& terms, const Scalar& alpha, const Scalar& t) {
  Scalar sum = alpha * 0.0;
  for (std::size_t j = terms.size(); j-- > 0;) {
    Scalar row = alpha * 0.0;
    for (std::size_t i = terms[j].size(); i-- > 0;) row = row * alpha + static_cast<double>(terms[j][i]);
    sum = sum * t + row;
  }
  return sum;
}

// A FormEnds holds the range in which a form is evaluated, as floats.
struct FormEnds {
  float width_min = 0.0f, width_max = 0.0f;  // the domain, in the width parameter of the source
  float width_from = 0.0f, width_to = 0.0f;  // range for clamping; the end towards a mirror is not limited
  float alpha_min = 0.0f;                    // alpha of the sharpest source texel in the domain
  float least_alpha = 0.0f;                  // smallest alpha of the target, because exponents are finite
};
// Returns the range in which a form is evaluated for the domain `width`.
FormEnds ends_of(RoughnessEncoding source, RoughnessEncoding target, const Range& width);

}  // namespace remap
