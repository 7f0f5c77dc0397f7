#include "warp/registration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/LU>

#include "warp/decompositions.hpp"

namespace remap {
namespace {

constexpr int kLeastTexels = 4;
constexpr int kSearchSteps = 8;
constexpr double kCoarsest = 20.0, kFinest = 120.0;  // number of bins along the largest extent

double largest_extent(const Points& positions) {
  double extent = 0.0;
  for (Eigen::Index k = 0; k < positions.cols(); ++k) {
    const Range own = extent_of(positions, k);
    extent = std::max(extent, own.max - own.min);
  }
  return extent;
}

std::vector<int> count_texels(const Points& positions, const BinGrid& grid) {
  std::vector<int> counts(grid.size(), 0);
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    if (const long bin = grid.bin_of(positions, i); bin >= 0) ++counts[static_cast<std::size_t>(bin)];
  return counts;
}

constexpr double kWantedPoints = 350.0;

double search_spacing(const Points& positions) {
  const double extent = largest_extent(positions);
  double spacing = extent / kCoarsest;
  for (int step = 0; step < kSearchSteps; ++step) {
    const std::vector<int> counts = count_texels(positions, BinGrid(positions, spacing));
    const auto occupied = std::ranges::count_if(counts, [](int count) { return count >= kLeastTexels; });
    const double ratio = static_cast<double>(std::max<std::ptrdiff_t>(occupied, 1)) / kWantedPoints;
    if (std::abs(ratio - 1.0) < 0.08) break;
    spacing *= std::pow(ratio, 0.8 / static_cast<double>(positions.cols()));
    spacing = std::clamp(spacing, extent / kFinest, extent / 2.0);
  }
  return spacing;
}

int nearest_point(const Points& points, const Eigen::RowVectorXd& position) {
  Eigen::Index nearest = 0;
  (points.rowwise() - position).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

constexpr double kDifferenceStep = 0.01;  // in RMS radii

constexpr Eigen::Index kCentres = 80;
constexpr double kWidth = 1.2;  // in units of the RMS radius
constexpr int kSteps = 25;
constexpr double kFirstSigma = 0.4, kLastSigma = 0.05;
constexpr int kScalingRounds = 8;
constexpr double kScalingExponent = 0.8;
constexpr double kStrokeWeight = 1.5;
constexpr double kBending = 10.0;
constexpr double kPrior = 0.3;

// Samples points that are far apart. The first point is the farthest from the mean. Each further point is the
// farthest from all previous points.
Points farthest_points(const Points& points, Eigen::Index wanted) {
  const Eigen::Index count = std::min(wanted, points.rows());
  Points chosen(count, points.cols());
  Eigen::VectorXd distance = (points.rowwise() - points.colwise().mean()).rowwise().squaredNorm();
  for (Eigen::Index c = 0; c < count; ++c) {
    Eigen::Index farthest = 0;
    distance.maxCoeff(&farthest);
    chosen.row(c) = points.row(farthest);
    const Eigen::VectorXd next = (points.rowwise() - chosen.row(c)).rowwise().squaredNorm();
    distance = c == 0 ? next : Eigen::VectorXd(distance.cwiseMin(next));
  }
  return chosen;
}

Points rows_of(const Points& points, const std::vector<int>& rows) { return points(rows, Eigen::all); }

// A SoftMatch holds soft matches between two sets of points, by unbalanced Sinkhorn scaling (Chizat et al.
// 2018). For each moved point, `mass` is the degree of the match (about 1 / count), and `target` is the
// matched position.
struct SoftMatch {
  Eigen::VectorXd mass;
  Points target;
};
SoftMatch match_softly(const Points& moved, const Points& goal, double sigma) {
  const Eigen::MatrixXd kernel = gaussians(moved, goal, sigma);
  const double row_mass = 1.0 / static_cast<double>(moved.rows());
  const double column_mass = 1.0 / static_cast<double>(goal.rows());
  const auto scaling = [](double mass, const Eigen::VectorXd& sums) -> Eigen::VectorXd {
    return (mass / sums.array().max(1e-300)).pow(kScalingExponent);
  };
  Eigen::VectorXd rows = Eigen::VectorXd::Ones(moved.rows()), columns = Eigen::VectorXd::Ones(goal.rows());
  for (int round = 0; round < kScalingRounds; ++round) {
    rows = scaling(row_mass, kernel * columns);
    columns = scaling(column_mass, kernel.transpose() * rows);
  }
  SoftMatch match;
  const Eigen::VectorXd sums = kernel * columns;
  match.mass = rows.cwiseProduct(sums);
  match.target = kernel * (columns.asDiagonal() * goal);
  match.target.array().colwise() /= sums.array().max(1e-300);
  return match;
}

// A Pull states how strongly each point is attracted, and where to. It holds sums of weights and of weighted
// targets.
struct Pull {
  Eigen::VectorXd weight;
  Points weighted;
};

// Computes how points are attracted. All points of strokes have the same weight. The masses are not
// normalised. So strokes far from their partners have less effect, and so have points without a match.
Pull pull_of(const PointSets& sets, const Points& moved, double sigma) {
  const SoftMatch all = match_softly(moved, sets.target.points, sigma);
  Pull pull{all.mass, all.mass.asDiagonal() * all.target};
  const std::vector<std::vector<int>>& strokes = sets.source.strokes;
  std::size_t total = 0;
  for (const std::vector<int>& members : strokes) total += members.size();
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    const std::vector<int>& members = strokes[k];
    const SoftMatch own =
        match_softly(rows_of(moved, members), rows_of(sets.target.points, sets.target.strokes[k]), sigma);
    const double scale = kStrokeWeight * static_cast<double>(members.size()) / static_cast<double>(total);
    for (std::size_t i = 0; i < members.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      pull.weight[members[i]] += scale * own.mass[row];
      pull.weighted.row(members[i]) += scale * own.mass[row] * own.target.row(row);
    }
  }
  return pull;
}

}  // namespace

Range extent_of(const Points& positions, Eigen::Index axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    low = std::min(low, positions(i, axis));  // comparisons with NaN change neither `low` nor `high`
    high = std::max(high, positions(i, axis));
  }
  return {low, high};
}

Eigen::RowVectorXd centre_of(const Points& positions, const std::vector<std::uint32_t>& texels) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(positions.cols());
  double count = 0.0;
  for (const std::uint32_t texel : texels) {
    const Eigen::RowVectorXd position = positions.row(static_cast<Eigen::Index>(texel));
    if (!position.allFinite()) continue;
    sum += position;
    count += 1.0;
  }
  return sum / std::max(count, 1.0);
}

BinGrid::BinGrid(const Points& positions, double spacing) : dimension_(positions.cols()), spacing_(spacing) {
  for (Eigen::Index k = 0; k < dimension_; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const Range extent = extent_of(positions, k);
    low_[axis] = extent.min;
    cells_[axis] = static_cast<long>((extent.max - extent.min) / spacing) + 1;
    size_ *= static_cast<std::size_t>(cells_[axis]);
  }
}

long BinGrid::bin_of(const Points& positions, Eigen::Index i) const noexcept {
  long bin = 0;
  for (auto k = static_cast<std::size_t>(dimension_); k-- > 0;) {
    const double place = (positions(i, static_cast<Eigen::Index>(k)) - low_[k]) / spacing_;
    if (!(place >= 0.0 && place < static_cast<double>(cells_[k]))) return -1;
    bin = bin * cells_[k] + static_cast<long>(place);
  }
  return bin;
}

Occupancy occupancy_of(const Points& positions, const std::vector<std::vector<std::uint32_t>>& strokes) {
  Occupancy result;
  result.spacing = search_spacing(positions);
  const BinGrid grid(positions, result.spacing);
  const std::vector<int> counts = count_texels(positions, grid);
  // If the material has few texels, bins with fewer than kLeastTexels texels are used as well.
  const bool is_sparse = *std::ranges::max_element(counts) < 4 * kLeastTexels;
  const int least = is_sparse ? 1 : kLeastTexels;

  std::vector<int> point_of(grid.size(), -1);
  int point_count = 0;
  for (std::size_t bin = 0; bin < counts.size(); ++bin)
    if (counts[bin] >= least) point_of[bin] = point_count++;
  result.points = Points::Zero(point_count, positions.cols());
  result.texel_count = Eigen::VectorXd::Zero(point_count);
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    const long bin = grid.bin_of(positions, i);
    const int point = bin < 0 ? -1 : point_of[static_cast<std::size_t>(bin)];
    if (point < 0) continue;
    for (Eigen::Index k = 0; k < positions.cols(); ++k) result.points(point, k) += positions(i, k);
    result.texel_count[point] += 1.0;
  }
  result.points.array().colwise() /= result.texel_count.array();

  for (const std::vector<std::uint32_t>& texels : strokes) {
    std::vector<int> members;
    for (const std::uint32_t texel : texels) {
      const long bin = grid.bin_of(positions, static_cast<Eigen::Index>(texel));
      if (bin >= 0 && point_of[static_cast<std::size_t>(bin)] >= 0)
        members.push_back(point_of[static_cast<std::size_t>(bin)]);
    }
    std::ranges::sort(members);
    members.erase(std::unique(members.begin(), members.end()), members.end());
    if (members.empty()) members.push_back(nearest_point(result.points, centre_of(positions, texels)));
    result.strokes.push_back(std::move(members));
  }
  return result;
}

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

Eigen::MatrixXd common_axes(const AppearanceSpace& source, const AppearanceSpace& target, int dimension) {
  return nearest_orthogonal(source.axes.leftCols(dimension).transpose() * target.axes.leftCols(dimension));
}

Points stroke_centres(const Points& positions, const std::vector<std::vector<std::uint32_t>>& strokes) {
  Points centres = Points::Zero(static_cast<Eigen::Index>(strokes.size()), positions.cols());
  for (std::size_t k = 0; k < strokes.size(); ++k)
    centres.row(static_cast<Eigen::Index>(k)) = centre_of(positions, strokes[k]);
  return centres;
}

AffineMap affine_from_strokes(const PointSets& sets) {
  const Eigen::RowVectorXd from_mean = sets.source_centres.colwise().mean();
  const Eigen::RowVectorXd to_mean = sets.target_centres.colwise().mean();
  const Points from = sets.source_centres.rowwise() - from_mean, to = sets.target_centres.rowwise() - to_mean;
  const Eigen::Index n = from.cols();
  const Eigen::MatrixXd left = from.transpose() * from + kPrior * Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd linear = solve_symmetric(left, from.transpose() * to + kPrior * sets.common_axes);
  return {linear, to_mean - from_mean * linear};
}

SmoothWarp register_points(const PointSets& sets, const AffineMap& start) {
  const Points& points = sets.source.points;
  SmoothWarp warp{start, farthest_points(points, kCentres), {}, kWidth};
  const Eigen::Index n = points.cols(), centres = warp.centres.rows(), unknowns = centres + n + 1;
  warp.weights = Eigen::MatrixXd::Zero(centres, n);
  Eigen::MatrixXd design(points.rows(), unknowns);
  design << gaussians(points, warp.centres, kWidth), points, Eigen::VectorXd::Ones(points.rows());
  const Eigen::MatrixXd kernel = gaussians(warp.centres, warp.centres, kWidth);
  Points moved = images_of(start, points);
  for (int step = 0; step < kSteps; ++step) {
    const double share = static_cast<double>(step) / static_cast<double>(kSteps - 1);
    const double sigma = kFirstSigma * std::pow(kLastSigma / kFirstSigma, share);
    const Pull pull = pull_of(sets, moved, sigma);
    const Eigen::MatrixXd weighted = design.transpose() * pull.weight.asDiagonal();
    Eigen::MatrixXd left = weighted * design;
    left.topLeftCorner(centres, centres) +=
        kBending * sigma * sigma / 0.05 / static_cast<double>(kCentres) * kernel;
    left.diagonal().array() += 1e-9 * left.trace() / static_cast<double>(unknowns);
    const Eigen::MatrixXd solution = solve_symmetric(left, design.transpose() * pull.weighted);
    warp.weights = solution.topRows(centres);
    warp.affine = {solution.middleRows(centres, n), solution.row(unknowns - 1)};
    moved = design * solution;
  }
  return warp;
}

}  // namespace remap
