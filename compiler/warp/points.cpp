#include "warp/points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

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
    const auto occupied =
        std::count_if(counts.begin(), counts.end(), [](int count) { return count >= kLeastTexels; });
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
  const bool is_sparse = *std::max_element(counts.begin(), counts.end()) < 4 * kLeastTexels;
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
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    if (members.empty()) members.push_back(nearest_point(result.points, centre_of(positions, texels)));
    result.strokes.push_back(std::move(members));
  }
  return result;
}

}  // namespace remap
