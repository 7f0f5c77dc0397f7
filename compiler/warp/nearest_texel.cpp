#include "warp/nearest_texel.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <nanoflann.hpp>

namespace remap {
namespace {

// This is the interface that nanoflann requires of a list of points.
template <std::size_t kDimension>
struct PointList {
  std::vector<std::array<float, kDimension>> points;
  std::vector<std::uint32_t> rows;

  std::size_t kdtree_get_point_count() const { return rows.size(); }
  float kdtree_get_pt(std::size_t point, std::size_t axis) const { return points[point][axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

constexpr std::size_t kLeafSize = 32;

// The dimension is a template parameter, because that doubles the speed.
template <std::size_t kDimension>
struct Tree {
  using List = PointList<kDimension>;
  using Distance = nanoflann::L2_Simple_Adaptor<float, List>;
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<Distance, List, static_cast<int>(kDimension), std::uint32_t>;

  explicit Tree(const Points& positions)
      : list(list_of(positions)),
        index(static_cast<int>(kDimension), list, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {}

  static std::array<float, kDimension> point_of(const Points& positions, Eigen::Index row) {
    std::array<float, kDimension> point{};
    for (std::size_t k = 0; k < kDimension; ++k)
      point[k] = static_cast<float>(positions(row, static_cast<Eigen::Index>(k)));
    return point;
  }

  static List list_of(const Points& positions) {
    List list;
    list.points.reserve(static_cast<std::size_t>(positions.rows()));
    list.rows.reserve(static_cast<std::size_t>(positions.rows()));
    for (Eigen::Index row = 0; row < positions.rows(); ++row) {
      if (!positions.row(row).allFinite()) continue;
      list.points.push_back(point_of(positions, row));
      list.rows.push_back(static_cast<std::uint32_t>(row));
    }
    return list;
  }

  std::vector<std::uint32_t> find(const Points& points) const {
    std::vector<std::uint32_t> nearest(static_cast<std::size_t>(points.rows()));
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const std::array<float, kDimension> query = point_of(points, i);
      std::uint32_t found = 0;
      float distance = 0.0f;
      index.knnSearch(query.data(), 1, &found, &distance);
      nearest[static_cast<std::size_t>(i)] = list.rows[found];
    }
    return nearest;
  }

  List list;
  Index index;
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
