// The box that a ragged region of (alpha, specular) holds: the domain of a fit.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "remap/fit.hpp"

namespace remap {

// A strip of the region: the widths from `first` to `last`, covered from specular 0 up to `reach`.
struct CoveredColumn {
  double first = 0.0, last = 0.0;
  double reach = 0.0;   // 0: not covered
  bool is_gap = false;  // nothing is known of it; its neighbours speak for it
};

// The box within columns in rising order that is best to convert in; none where no column is covered. Beyond
// a domain specular is extrapolated in proportion, which is exact to some tenths of a percent between models
// that scale, while a width that is held at the edge is simply wrong: the wider range wins unless it costs
// more than the fourth power of its gain in specular.
std::optional<Domain> covered_box(const std::vector<CoveredColumn>& columns);

}  // namespace remap
