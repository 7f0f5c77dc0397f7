// Histogram matching, a baseline for the registration.
#pragma once

#include "warp/registration.hpp"

namespace remapc {

// Histogram matching in several dimensions (Pitie et al. 2007) of occupied points with equal weights: matches
// ranks along every axis in 20 rotations. Returns the new positions of `from`. Deterministic.
Points match_histograms(const Points& from, const Points& to);

// Applies affine_from_strokes() to all points, then match_histograms().
ShiftedPoints warp_by_histograms(const PointSets& sets);

}  // namespace remapc
