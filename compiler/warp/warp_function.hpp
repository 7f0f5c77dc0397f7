// Maps from the source's appearance space into the template's: what each method ends in.
#pragma once

#include <variant>
#include <vector>

#include <Eigen/Core>

#include "warp/space/coordinates.hpp"

namespace remapc {

// Rows are points: F(x) = x linear + offset.
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

// An affine map a point by moving least squares (Schaefer et al. 2006): least squares over `from` -> `to`
// with weights exp(-(|x - from|^2 - least) / (2 width^2)), drawn to `global` by a thousandth of a thousandth.
struct MovingAffine {
  Points from, to;
  double width = 1.0;
  AffineMap global;
};

// F(x) = start(x) + the correction of the nearest bin at x: affine maps that were moved on from those of
// `start`.
struct BinnedAffine {
  MovingAffine start;
  Points bins;
  std::vector<AffineMap> corrections;  // one each
};

// The map of a point by moving least squares.
AffineMap affine_at(const MovingAffine& warp, const Eigen::RowVectorXd& point);

using AppearanceWarp = std::variant<AffineMap, SmoothWarp, ShiftedPoints, MovingAffine, BinnedAffine>;

// The images of points, a row each. A point that is NaN gives NaN.
Points images_of(const AppearanceWarp& warp, const Points& points);

// The exp(...) of a SmoothWarp: points x centres.
Eigen::MatrixXd gaussians(const Points& points, const Points& centres, double width);

// The share of `weights` at points where the orientation of the warp (the sign of its Jacobian's determinant,
// by central differences) is not that of the majority: there the source is turned inside out.
double fold_share(const AppearanceWarp& warp, const Points& points, const Eigen::VectorXd& weights);

}  // namespace remapc
