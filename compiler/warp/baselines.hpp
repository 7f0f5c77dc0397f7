// What the registration is compared with: histogram matching.
#pragma once

#include "warp/registration.hpp"

namespace remapc {

// Histogram matching in several dimensions (Pitie et al. 2007) on occupied points, each of weight one: 20
// rotations, in each of which ranks along every axis are matched. Returns where `from` is moved to.
// Deterministic.
Points match_histograms(const Points& from, const Points& to);

// The images of all points by affine_from_strokes(), moved on by match_histograms().
ShiftedPoints warp_by_histograms(const PointSets& sets);

}  // namespace remapc
