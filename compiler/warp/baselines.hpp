// What the registration is compared with: histogram matching, and the initialisation of An et al. 2011.
#pragma once

#include "warp/registration.hpp"

namespace remapc {

// Histogram matching in several dimensions (Pitie et al. 2007) on occupied points, each of weight one: 20
// rotations, in each of which ranks along every axis are matched. Returns where `from` is moved to.
// Deterministic.
Points match_histograms(const Points& from, const Points& to);

// The images of all points by affine_from_strokes(), moved on by match_histograms().
ShiftedPoints warp_by_histograms(const PointSets& sets);

// The initialisation of An et al. 2011, section 3.3: histogram matching of each stroke pair, then the nearest
// of the template's points there, then moving least squares with sigma .2 of the diagonal of the template's
// box. The simplex search that the paper starts from here tidies single bins at the rim and does not change
// the result (error 14.61 % before and 14.63 % after a minute of it), so it is left out.
MovingAffine warp_of_paper(const PointSets& sets);

}  // namespace remapc
