// This file computes the warp, a map from the source's appearance space to the template's, from strokes and
// points. Strokes give an affine map. From there, both sets of points are registered by annealing, with a
// bending prior.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "warp/coordinates.hpp"
#include "warp/points.hpp"

namespace remap {

// An AffineMap is F(x) = x linear + offset, where rows are points.
struct AffineMap {
  Eigen::MatrixXd linear;     // dimension x dimension
  Eigen::RowVectorXd offset;  // dimension values
};

// A SmoothWarp is F(x) = x linear + offset + sum_c weights_c exp(-|x - centre_c|^2 / (2 width^2)).
struct SmoothWarp {
  AffineMap affine;
  Points centres;
  Eigen::MatrixXd weights;  // centres x dimension
  double width = 1.0;
};

// Return the images of points, one row per point. NaN gives NaN.
Points images_of(const AffineMap& map, const Points& points);
Points images_of(const SmoothWarp& warp, const Points& points);

// Returns the factors exp(...) of a SmoothWarp: points x centres.
Eigen::MatrixXd gaussians(const Points& points, const Points& centres, double width);

// Returns the fraction of `weights` at points where the warp folds. There, its orientation differs from the
// orientation at most points. The orientation is the sign of the determinant of the Jacobian, which central
// differences give.
double fold_share(const SmoothWarp& warp, const Points& points, const Eigen::VectorXd& weights);

// A PointSets holds both materials as points. `common_axes` maps each source axis to the direction of the
// same change of reflectance in the template. It is the rotation (or reflection) closest to V_S^T V_T.
struct PointSets {
  Occupancy source, target;
  Eigen::MatrixXd common_axes;  // dimension x dimension
  Points source_centres;        // centres of the texels of each stroke
  Points target_centres;
};

Eigen::MatrixXd common_axes(const AppearanceSpace& source, const AppearanceSpace& target, int dimension);

// Returns the mean position of the finite texels of each stroke, one row per stroke.
Points stroke_centres(const Points& positions, const std::vector<std::vector<std::uint32_t>>& strokes);

// Fits the centres of strokes by least squares, with the prior |linear - common axes|^2. The prior determines
// directions that the strokes leave open. Its weight is high (0.3), so that a registration starts close to
// the common axes.
AffineMap affine_from_strokes(const PointSets& sets);

// Computes a SmoothWarp with 80 centres of width 1.2 in 25 steps with sigma from 0.4 to 0.05. Each step
// matches all points softly, and separately the points of every stroke pair with 1.5 times the weight. Then
// it solves one linear least squares problem with the bending prior 10 sigma^2 / 0.05 w' K w / 80. The
// optimum is flat: half or twice any of these numbers changes the error by about one percentage point. The
// result is deterministic.
SmoothWarp register_points(const PointSets& sets, const AffineMap& start);

}  // namespace remap
