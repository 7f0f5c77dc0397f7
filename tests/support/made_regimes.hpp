// A conversion with every regime in closed form, and the fit that holds it.
#pragma once

#include <algorithm>

#include "lower/fit.hpp"

namespace made_regimes {

// Alpha grows by half until .9 at .6; specular by .6, less beyond that width, until 1; from there on widths
// shrink.
inline constexpr double kAlphaLimit = 0.9, kSpecularLimit = 1.0, kWideFrom = 0.6, kBrightFrom = 0.625;
inline constexpr double kMappingTo =
    kWideFrom * 1.006;  // the mapping passes its limit by the seam, and a little

inline double free_alpha(double alpha) { return std::min(1.5 * alpha, kAlphaLimit); }
inline double free_specular(double alpha, double specular) {
  return specular * (1.6 - 0.5 * std::max(alpha - kWideFrom, 0.0));
}
inline double bright_alpha(double alpha, double specular) {
  return std::min(alpha * (1.5 - 0.4 * (specular - kBrightFrom)), kAlphaLimit);
}

enum class Place { kInside, kWide, kBright, kCorner };
inline Place place(double alpha, double specular) {
  const bool is_bright = free_specular(alpha, specular) > kSpecularLimit;
  const double width = is_bright ? bright_alpha(alpha, specular) : free_alpha(alpha);
  if (width < kAlphaLimit) return is_bright ? Place::kBright : Place::kInside;
  return is_bright ? Place::kCorner : Place::kWide;
}
inline remap::MappedTexel exact(double alpha, double specular) {
  const double width =
      free_specular(alpha, specular) > kSpecularLimit ? bright_alpha(alpha, specular) : free_alpha(alpha);
  return {width, std::min(free_specular(alpha, specular), kSpecularLimit)};
}

// The series of a function that is linear in both parameters.
template <typename Function>
remap::TexelSeries bilinear(const remap::Range& alpha, const remap::Range& specular,
                            const Function& function) {
  const double a = function(alpha.min, specular.min), b = function(alpha.max, specular.min),
               c = function(alpha.min, specular.max), d = function(alpha.max, specular.max);
  return {alpha,
          specular,
          {{(a + b + c + d) / 4.0, (b + d - a - c) / 4.0}, {(c + d - a - b) / 4.0, (a + d - b - c) / 4.0}}};
}

inline remap::Fit fit() {
  using namespace remap;
  Fit fit;
  fit.id = "made_regimes";
  fit.source.model = "x/a";
  fit.target.model = "x/b";
  fit.domain = {{0.01, 1.0}, {0.0, 1.0}};
  fit.mapping = Parametric{{{1.5}}, {{1, {1.6, 0.0, 0.0, 0.0, 0.0, 0.0}}}};
  fit.regimes.alpha_limit = kAlphaLimit;
  fit.regimes.specular_limit = kSpecularLimit;
  fit.regimes.wide = {kMappingTo, bilinear({kWideFrom, 1.0}, {0.0, 1.0}, free_specular)};
  fit.regimes.bright = bilinear({0.01, 1.0}, {kBrightFrom, 1.0},
                                [](double a, double s) { return a * (1.5 - 0.4 * (s - kBrightFrom)); });
  return fit;
}

}  // namespace made_regimes
