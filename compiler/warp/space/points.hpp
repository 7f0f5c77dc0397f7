// Occupancy: the few hundred points that stand for all texels of a material, so that a rare appearance counts
// as much as a frequent one (An et al. 2011, section 3.2).
#pragma once

#include <cstdint>
#include <vector>

#include "warp/space/coordinates.hpp"

namespace remapc {

// The least and the largest coordinate along an axis; NaN takes no part.
struct Extent {
  double low = 0.0, high = 0.0;
};
Extent extent_of(const Points& positions, Eigen::Index axis);

// The mean position of these texels; those that are not finite take no part. None left: the origin.
Eigen::RowVectorXd centre_of(const Points& positions, const std::vector<std::uint32_t>& texels);

struct Occupancy {
  Points points;                          // centroids of the bins that hold four texels or more
  Eigen::VectorXd texel_count;            // of each
  std::vector<std::vector<int>> strokes;  // the points with a texel of each stroke; at least one
  double spacing = 0.0;                   // edge of a bin
};

inline constexpr double kWantedPoints = 350.0;

// Bins whose spacing is searched so that about `wanted` are occupied, at least four texels for each: what
// lies between 300 and 1200 points changes results by a point of error. `positions` of texels (NaN takes no
// part); `strokes` hold indices of texels. A stroke all of whose texels lie in bins that are too sparse gets
// the point nearest to its centre.
Occupancy occupancy_of(const Points& positions, const std::vector<std::vector<std::uint32_t>>& strokes,
                       double wanted = kWantedPoints);

// The bin of every position in the grid of `occupancy_of` (-1: none that counts), for coverage.
class BinGrid {
 public:
  BinGrid(const Points& positions, double spacing);
  std::size_t size() const noexcept { return size_; }
  // NaN is in no bin: -1.
  long bin_of(const double* position) const noexcept;
  long bin_of(const Points& positions, Eigen::Index i) const noexcept;

 private:
  Eigen::Index dimension_ = 0;
  double spacing_ = 1.0;
  std::array<double, 3> low_{};
  std::array<long, 3> cells_{1, 1, 1};
  std::size_t size_ = 1;
};

}  // namespace remapc
