// The regimes of a fit. A target model takes widths and speculars up to a limit. Where the best match lies beyond
// one, the best of what the target can do is at that limit, and the other parameter is free along it:
//
//   inside  neither parameter is at its limit: the mapping of the fit
//   wide    target alpha is at its limit; specular is free
//   bright  target specular is at its limit; alpha is free
//   corner  both are at their limits
//
// The answer of each regime is a smooth function of the source's parameters, and neighbours agree where they meet.
// So each is fitted by itself, and evaluation selects: the mapping says whether alpha reaches its limit, then the
// specular of that regime says whether specular does.
#pragma once

#include <optional>
#include <vector>

#include "remap/mapping.hpp"

namespace remap {

// The sum over powers j of specular and i of alpha of coefficients[j][i] specular^j alpha^i.
using TexelPolynomial = std::vector<std::vector<double>>;

struct WideRegime {
  // The mapping reaches the limit of alpha between these widths of the source, whatever the specular: it is evaluated
  // up to `mapping_to`, and `specular` from `from`. Beyond, each is held.
  double from = 0.0;
  double mapping_to = 1.0;
  TexelPolynomial specular;  // target specular
  bool operator==(const WideRegime&) const = default;
};

struct BrightRegime {
  // The least width and specular of the source whose matches are bright; below, each is held.
  double alpha_from = 0.0, specular_from = 0.0;
  Network alpha;               // of alpha and specular: target alpha
  bool operator==(const BrightRegime&) const = default;
};

// Without a regime, the mapping is cut off at the limit.
struct Regimes {
  double alpha_limit = 1.0;              // the largest target alpha, canonical
  std::optional<double> specular_limit;  // the largest target specular; none: not known
  std::optional<WideRegime> wide;
  std::optional<BrightRegime> bright;  // needs specular_limit
  bool operator==(const Regimes&) const = default;
};

}  // namespace remap
