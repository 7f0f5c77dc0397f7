#include "warp/warp_function.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/LU>

namespace remap {
namespace {

constexpr double kDifferenceStep = 0.01;  // in RMS radii

}  // namespace

Eigen::MatrixXd gaussians(const Points& points, const Points& centres, double width) {
  Eigen::MatrixXd exponents(points.rows(), centres.rows());
  const double scale = -0.5 / (width * width);
  for (Eigen::Index c = 0; c < centres.rows(); ++c)
    exponents.col(c) = scale * (points.rowwise() - centres.row(c)).rowwise().squaredNorm();
  return exponents.array().exp();
}

Points images_of(const AffineMap& map, const Points& points) {
  return (points * map.linear).rowwise() + map.offset;
}

Points images_of(const SmoothWarp& warp, const Points& points) {
  return images_of(warp.affine, points) + gaussians(points, warp.centres, warp.width) * warp.weights;
}

double fold_share(const SmoothWarp& warp, const Points& points, const Eigen::VectorXd& weights) {
  const Eigen::Index n = points.cols();
  std::vector<Points> columns;  // columns of the Jacobians, at all points
  for (Eigen::Index k = 0; k < n; ++k) {
    Points ahead = points, behind = points;
    ahead.col(k).array() += kDifferenceStep;
    behind.col(k).array() -= kDifferenceStep;
    columns.push_back(images_of(warp, ahead) - images_of(warp, behind));
  }
  double negative = 0.0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    Eigen::MatrixXd jacobian(n, n);
    for (Eigen::Index k = 0; k < n; ++k) jacobian.row(k) = columns[static_cast<std::size_t>(k)].row(i);
    if (jacobian.determinant() < 0.0) negative += weights[i];
  }
  const double share = negative / weights.sum();
  return std::min(share, 1.0 - share);
}

}  // namespace remap
