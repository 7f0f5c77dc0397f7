// This file finds the domain of a fit. The region of (alpha, specular) that a table covers may have any
// shape, and the domain is a box inside of it.
#pragma once

#include <optional>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

// A CoveredColumn is a strip of the region: alpha from `first` to `last`, covered from specular 0 to `reach`.
struct CoveredColumn {
  double first = 0.0, last = 0.0;
  double reach = 0.0;   // 0 if the column is not covered
  bool is_gap = false;  // true if there is no data, so a box may contain this column
};

// Returns the best box within columns in rising order, or nothing if no column is covered. Outside of a
// domain, specular is extrapolated in proportion, which costs only a few tenths of a percent. Alpha is
// clamped, which is wrong. So a box with a wider range of alpha wins, unless its range of specular shrinks by
// more than the fourth power of what alpha gains.
std::optional<Domain> covered_box(const std::vector<CoveredColumn>& columns);

}  // namespace remap
