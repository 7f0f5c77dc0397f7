#include "warp/nearest_texel.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <nanoflann.hpp>

namespace remap {
namespace {

constexpr std::size_t kLeafSize = 32;

// A Tree finds the closest of a list of points. The dimension is a template parameter, because that doubles
// the speed.
template <std::size_t kDimension>
class Tree {
 public:
  using Distance = nanoflann::L2_Simple_Adaptor<float, Tree>;
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<Distance, Tree, static_cast<int>(kDimension), std::uint32_t>;

  explicit Tree(const Points& positions) {
    points_.reserve(static_cast<std::size_t>(positions.rows()));
    rows_.reserve(static_cast<std::size_t>(positions.rows()));
    for (Eigen::Index row = 0; row < positions.rows(); ++row) {
      if (!positions.row(row).allFinite()) continue;
      points_.push_back(point_of(positions, row));
      rows_.push_back(static_cast<std::uint32_t>(row));
    }
    index_ = std::make_unique<Index>(static_cast<int>(kDimension), *this,
                                     nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize));
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  // nanoflann requires these functions of a list of points.
  std::size_t kdtree_get_point_count() const { return rows_.size(); }
  float kdtree_get_pt(std::size_t point, std::size_t axis) const { return points_[point][axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  std::vector<std::uint32_t> find(const Points& points) const {
    std::vector<std::uint32_t> nearest(static_cast<std::size_t>(points.rows()));
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const std::array<float, kDimension> query = point_of(points, i);
      std::uint32_t found = 0;
      float distance = 0.0f;
      index_->knnSearch(query.data(), 1, &found, &distance);
      nearest[static_cast<std::size_t>(i)] = rows_[found];
    }
    return nearest;
  }

 private:
  static std::array<float, kDimension> point_of(const Points& positions, Eigen::Index row) {
    std::array<float, kDimension> point{};
    for (std::size_t k = 0; k < kDimension; ++k)
      point[k] = static_cast<float>(positions(row, static_cast<Eigen::Index>(k)));
    return point;
  }

  std::vector<std::array<float, kDimension>> points_;
  std::vector<std::uint32_t> rows_;
  std::unique_ptr<Index> index_;
};

template <std::size_t kDimension>
NearestTexel nearest_in(const Points& positions) {
  return [tree = std::make_shared<const Tree<kDimension>>(positions)](const Points& points) {
    return tree->find(points);
  };
}

}  // namespace

NearestTexel nearest_texel(const Points& positions) {
  if (positions.cols() == 1) return nearest_in<1>(positions);
  if (positions.cols() == 2) return nearest_in<2>(positions);
  return nearest_in<3>(positions);
}

}  // namespace remap
