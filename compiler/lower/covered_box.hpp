// This file finds the domain of a fit: a box within the (ragged) covered region of (alpha, specular).
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "lower/fit.hpp"

namespace remap {

// A CoveredColumn is a strip of the region: alpha from `first` to `last`, covered from specular 0 to `reach`.
struct CoveredColumn {
  double first = 0.0, last = 0.0;
  double reach = 0.0;   // 0 if the column is not covered
  bool is_gap = false;  // has no data; the box may span it
};

// Returns the best box within columns in rising order, or nothing if no column is covered. Outside a domain,
// specular is extrapolated in proportion, with errors of a few tenths of a percent between models that scale.
// Alpha is clamped, which is wrong. So the wider alpha range wins unless specular shrinks by more than the
// fourth power of the gain.
std::optional<Domain> covered_box(const std::vector<CoveredColumn>& columns);

}  // namespace remap
