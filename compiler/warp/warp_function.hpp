// This file holds maps from the source's appearance space to the template's.
#pragma once

#include <Eigen/Core>

#include "warp/coordinates.hpp"

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

}  // namespace remap
