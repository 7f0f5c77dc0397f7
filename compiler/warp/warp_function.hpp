// Maps from the source's appearance space to the template's: the results of the methods.
#pragma once

#include <variant>
#include <vector>

#include <Eigen/Core>

#include "warp/space/coordinates.hpp"

namespace remapc {

// F(x) = x linear + offset, where rows are points.
struct AffineMap {
  Eigen::MatrixXd linear;     // dimension x dimension
  Eigen::RowVectorXd offset;  // dimension
};

// F(x) = x linear + offset + sum_c weights_c exp(-|x - centre_c|^2 / (2 width^2)).
struct SmoothWarp {
  AffineMap affine;
  Points centres;
  Eigen::MatrixXd weights;  // centres x dimension
  double width = 1.0;
};

// F(x) = x + the shift of the nearest point.
struct ShiftedPoints {
  Points points;
  Points shifts;
};

// An affine map for each point by moving least squares (Schaefer et al. 2006): least squares over `from` ->
// `to` with weights exp(-(|x - from|^2 - least) / (2 width^2)), regularized towards `global` with weight
// 1e-6.
struct MovingAffine {
  Points from, to;
  double width = 1.0;
  AffineMap global;
};

// F(x) = start(x) + the affine correction of the bin nearest to x.
struct BinnedAffine {
  MovingAffine start;
  Points bins;
  std::vector<AffineMap> corrections;  // one per bin
};

// The moving least squares map of a point.
AffineMap affine_at(const MovingAffine& warp, const Eigen::RowVectorXd& point);

using AppearanceWarp = std::variant<AffineMap, SmoothWarp, ShiftedPoints, MovingAffine, BinnedAffine>;

// The images of points, one row per point. NaN gives NaN.
Points images_of(const AppearanceWarp& warp, const Points& points);

// The factors exp(...) of a SmoothWarp: points x centres.
Eigen::MatrixXd gaussians(const Points& points, const Points& centres, double width);

// The share of `weights` at points where the warp folds: where its orientation (the sign of the determinant
// of its Jacobian, by central differences) differs from that of the majority.
double fold_share(const AppearanceWarp& warp, const Points& points, const Eigen::VectorXd& weights);

}  // namespace remapc
