// The warp from strokes and occupancy: an affine map from the strokes, then an annealed registration of both
// point sets with a bending prior.
#pragma once

#include <vector>

#include "warp/space/points.hpp"
#include "warp/warp_function.hpp"

namespace remapc {

// Both materials as points, and the map that takes each axis of the source to where the template has the same
// change of reflectance: the rotation (or reflection) nearest to V_S^T V_T.
struct PointSets {
  Occupancy source, target;
  Eigen::MatrixXd common_axes;  // dimension x dimension
  Points source_centres;        // of the texels of each stroke
  Points target_centres;
};

Eigen::MatrixXd common_axes(const AppearanceSpace& source, const AppearanceSpace& target, int dimension);

// The means of the positions of each stroke's finite texels, a row each.
Points stroke_centres(const Points& positions, const std::vector<std::vector<std::uint32_t>>& strokes);

// Least squares over the centres of strokes, with the sum of squares prior |linear - common axes|^2 on top:
// directions that strokes do not fix follow the prior. A registration wants a strong one, to start near; a
// map that nothing follows is best with a weak one.
inline constexpr double kStartPrior = 0.3, kAlonePrior = 0.05;
AffineMap affine_from_strokes(const PointSets& sets, double prior = kStartPrior);

// Soft matches between two sets of points by unbalanced Sinkhorn scaling (Chizat et al. 2018): `mass`, how
// far each moved point is matched at all (about 1 / count), and where to.
struct SoftMatch {
  Eigen::VectorXd mass;
  Points target;
};
SoftMatch match_softly(const Points& moved, const Points& goal, double sigma);

// F of SmoothWarp with 80 centres of width 1.2. 25 steps, sigma .4 to .05: soft matches of all points, and
// those of every stroke pair apart with 1.5 times the weight; then one linear least squares with the bending
// prior 10 sigma^2 / .05 w' K w / 80. The optimum is flat: half or twice any of these numbers moves results
// by a point of error. Deterministic.
SmoothWarp register_points(const PointSets& sets, const AffineMap& start);

}  // namespace remapc
