#include "warp/baselines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>

namespace remapc {
namespace {

constexpr int kRotations = 20;

// Evenly spread rotations: the additive recurrence of the plastic numbers, mapped uniformly to quaternions
// (Shoemake 1992).
Eigen::MatrixXd rotation(Eigen::Index dimension, int index) {
  const auto part = [&](double step) { return std::fmod(0.5 + static_cast<double>(index) * step, 1.0); };
  if (dimension == 1) return Eigen::MatrixXd::Identity(1, 1);
  if (dimension == 2)
    return Eigen::Rotation2Dd(part(0.6180339887498949) * std::numbers::pi / 2.0).toRotationMatrix();
  const double a = part(0.8191725133961645), b = part(0.6710436067037893), c = part(0.5497004779019703);
  const double turn = 2.0 * std::numbers::pi;
  const Eigen::Quaterniond quaternion(std::sqrt(1.0 - a) * std::sin(turn * b),
                                      std::sqrt(1.0 - a) * std::cos(turn * b),
                                      std::sqrt(a) * std::sin(turn * c), std::sqrt(a) * std::cos(turn * c));
  return quaternion.toRotationMatrix();
}

// Replaces each value by the value of `goal` with the same relative rank.
void match_ranks(Eigen::Ref<Eigen::VectorXd> values, const Eigen::VectorXd& goal) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  std::vector<double> sorted(goal.begin(), goal.end());
  std::sort(sorted.begin(), sorted.end());
  const double last = static_cast<double>(sorted.size() - 1);
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double share = (static_cast<double>(rank) + 0.5) / static_cast<double>(order.size());
    const double place = std::clamp(share * static_cast<double>(sorted.size()) - 0.5, 0.0, last);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    values[order[rank]] =
        sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
  }
}

}  // namespace

Points match_histograms(const Points& from, const Points& to) {
  Points moved = from;
  for (int index = 0; index < kRotations; ++index) {
    const Eigen::MatrixXd axes = rotation(from.cols(), index);
    Points turned = moved * axes;
    const Points goal = to * axes;
    for (Eigen::Index k = 0; k < turned.cols(); ++k) match_ranks(turned.col(k), goal.col(k));
    moved = turned * axes.transpose();
  }
  return moved;
}

ShiftedPoints warp_by_histograms(const PointSets& sets) {
  const Points& points = sets.source.points;
  const Points start = images_of(affine_from_strokes(sets, kAlonePrior), points);
  return {points, match_histograms(start, sets.target.points) - points};
}

}  // namespace remapc
