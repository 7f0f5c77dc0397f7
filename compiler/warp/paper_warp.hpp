// The warp as An et al. 2011 print it (sections 3.1 and 3.3): affine maps at the occupied bins, initialised
// by moving least squares, then tidied by a simplex search of a few parameters at a time.
#pragma once

#include "warp/registration.hpp"

namespace remapc {

// Histogram matching of each stroke pair, then the nearest of the template's points there, then moving least
// squares with sigma .2 of the diagonal of the template's box.
MovingAffine initialisation_of_paper(const PointSets& sets);

struct PaperOptions {
  int rounds = 300;      // simplex searches
  int evaluations = 60;  // of the energy in each
};

struct PaperWarp {
  BinnedAffine warp;
  // Of the printed energy: squares in bins plus bins that do not overlap.
  double energy_before = 0.0, energy_after = 0.0;
};

// Minimises, over the affine maps M_b of the source's bins,
//   sum_b sum_b' z |(M_b - M_b') p_b|^2 - |S| / sum |S_k| sum_k O(T_k, R_k) - O(T, R)
// where O counts bins of equal occupancy, ten nearest neighbours each, in units of the template's bins. What
// the paper leaves open: |S| and |S_k| count bins; a bin stands for its centroid and two points beside it
// along each axis, a third of a bin away; each search takes one entry of the maps of ten bins that stand
// beside a mismatch. Searches after Nelder and Mead as Lagarias et al. 1998 have them. Deterministic. It
// moves results by less than a tenth of a point of error: the initialisation is what the method gives.
PaperWarp warp_of_paper(const PointSets& sets, const PaperOptions& options = {});

}  // namespace remapc
