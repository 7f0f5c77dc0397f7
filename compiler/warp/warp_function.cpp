#include "warp/warp_function.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "warp/nearest_texel.hpp"

namespace remapc {
namespace {

constexpr double kTowardsGlobal = 1e-6;
constexpr double kDifferenceStep = 0.01;  // in RMS radii

Points moved(const AffineMap& map, const Points& points) {
  return (points * map.linear).rowwise() + map.offset;
}

Points moved(const SmoothWarp& warp, const Points& points) {
  return moved(warp.affine, points) + gaussians(points, warp.centres, warp.width) * warp.weights;
}

Points moved(const ShiftedPoints& warp, const Points& points) {
  Points result = points;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    Eigen::Index nearest = 0;
    (warp.points.rowwise() - points.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
    result.row(i) += warp.shifts.row(nearest);
  }
  return result;
}

Points moved(const MovingAffine& warp, const Points& points) {
  Points result(points.rows(), points.cols());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const AffineMap map = affine_at(warp, points.row(i));
    result.row(i) = points.row(i) * map.linear + map.offset;
  }
  return result;
}

Points moved(const BinnedAffine& warp, const Points& points) {
  Points result = moved(warp.start, points);
  const std::vector<std::uint32_t> bins = NearestTexel(warp.bins).find(points);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const AffineMap& correction = warp.corrections[bins[static_cast<std::size_t>(i)]];
    result.row(i) += points.row(i) * correction.linear + correction.offset;
  }
  return result;
}

}  // namespace

AffineMap affine_at(const MovingAffine& warp, const Eigen::RowVectorXd& point) {
  const Eigen::ArrayXd distances = (warp.from.rowwise() - point).rowwise().squaredNorm();
  // The least distance is subtracted, because the weights would be 0 far from all strokes.
  const Eigen::ArrayXd exponents = (distances.minCoeff() - distances) / (2.0 * warp.width * warp.width);
  const Eigen::VectorXd weights = exponents.exp() / exponents.exp().sum();
  const Eigen::RowVectorXd centre = weights.transpose() * warp.from, image = weights.transpose() * warp.to;
  const Points from = warp.from.rowwise() - centre, to = warp.to.rowwise() - image;
  const Eigen::MatrixXd weighted = from.transpose() * weights.asDiagonal();
  const Eigen::Index n = point.size();
  const Eigen::MatrixXd left = weighted * from + kTowardsGlobal * Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd linear = left.ldlt().solve(weighted * to + kTowardsGlobal * warp.global.linear);
  return {linear, image - centre * linear};
}

Eigen::MatrixXd gaussians(const Points& points, const Points& centres, double width) {
  Eigen::MatrixXd exponents(points.rows(), centres.rows());
  const double scale = -0.5 / (width * width);
  for (Eigen::Index c = 0; c < centres.rows(); ++c)
    exponents.col(c) = scale * (points.rowwise() - centres.row(c)).rowwise().squaredNorm();
  return exponents.array().exp();
}

Points images_of(const AppearanceWarp& warp, const Points& points) {
  return std::visit([&](const auto& kind) { return moved(kind, points); }, warp);
}

double fold_share(const AppearanceWarp& warp, const Points& points, const Eigen::VectorXd& weights) {
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

}  // namespace remapc
