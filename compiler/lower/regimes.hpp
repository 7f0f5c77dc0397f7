// The regimes of a fit. A target model takes widths and speculars up to a limit. Where the best match lies
// beyond one, the best of what the target can do is at that limit, and the other parameter is free along it:
//
//   inside  neither parameter is at its limit: the mapping of the fit
//   wide    target alpha is at its limit; specular is free
//   bright  target specular is at its limit; alpha is free
//   corner  both are at their limits
//
// The answer of each regime is a smooth function of the source's parameters, and neighbours agree where they
// meet. So each is fitted by itself: the mapping says whether alpha reaches its limit, then the specular of
// that regime says whether specular does. A regime takes over in proportion while the parameter passes its
// limit by kSeam, so that results are continuous whatever the errors of the fits.
#pragma once

#include <optional>

#include "converter/lowered.hpp"
#include "lower/mapping.hpp"

namespace remap {

struct WideRegime {
  // The mapping passes the limit of alpha by kSeam before this width of the source, whatever the specular,
  // and is clamped beyond.
  double mapping_to = 1.0;
  TexelSeries specular;  // target specular
  bool operator==(const WideRegime&) const = default;
};

// Beyond the ranges of the series of a regime, its parameters are clamped. Without a regime, the mapping is
// cut off at the limit.
struct Regimes {
  double alpha_limit = 1.0;              // the largest target alpha, canonical
  std::optional<double> specular_limit;  // the largest target specular; none: not known
  std::optional<WideRegime> wide;
  std::optional<TexelSeries> bright;  // target alpha; needs specular_limit
  bool operator==(const Regimes&) const = default;
};

}  // namespace remap
