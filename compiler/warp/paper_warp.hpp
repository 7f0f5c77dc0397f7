// The warp as published by An et al. 2011 (sections 3.1 and 3.3): affine maps at the occupied bins,
// initialised by moving least squares, then refined by a simplex search over a few parameters at a time.
#pragma once

#include "warp/registration.hpp"

namespace remapc {

// Histogram matching of each stroke pair, then the nearest template points, then moving least squares with
// sigma 0.2 times the diagonal of the template's box.
MovingAffine initialisation_of_paper(const PointSets& sets);

struct PaperWarp {
  BinnedAffine warp;
  // The published energy: squared differences in bins plus the number of bins that do not overlap.
  double energy_before = 0.0, energy_after = 0.0;
};

// Minimises, over the affine maps M_b of the source's bins,
//   sum_b sum_b' z |(M_b - M_b') p_b|^2 - |S| / sum |S_k| sum_k O(T_k, R_k) - O(T, R)
// where O counts bins of equal occupancy, with ten nearest neighbors each, in units of the template's bins.
// The paper leaves details open. Here |S| and |S_k| count bins; a bin is represented by its centroid and two
// points a third of a bin away along each axis; each search varies one entry of the maps of ten bins next to
// a mismatch. The search is that of Nelder and Mead as described by Lagarias et al. 1998. Deterministic. The
// search changes the error by less than 0.1 percentage points, so the initialisation determines the result.
PaperWarp warp_of_paper(const PointSets& sets);

}  // namespace remapc
