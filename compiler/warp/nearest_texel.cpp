#include "warp/nearest_texel.hpp"

#include <array>
#include <cstddef>
#include <nanoflann.hpp>

namespace remapc {
namespace {

// What nanoflann asks of a list of points.
struct PointList {
  std::size_t dimension = 0;
  std::vector<float> values;
  std::vector<std::uint32_t> rows;

  std::size_t kdtree_get_point_count() const { return rows.size(); }
  float kdtree_get_pt(std::size_t point, std::size_t axis) const { return values[point * dimension + axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

constexpr std::size_t kLeafSize = 16;

}  // namespace

struct NearestTexel::Tree {
  using Distance = nanoflann::L2_Simple_Adaptor<float, PointList>;
  using Index = nanoflann::KDTreeSingleIndexAdaptor<Distance, PointList, -1, std::uint32_t>;

  explicit Tree(PointList list)
      : points(std::move(list)),
        index(static_cast<int>(points.dimension), points,
              nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {}

  PointList points;
  Index index;
};

NearestTexel::NearestTexel(const Points& positions) {
  PointList list;
  list.dimension = static_cast<std::size_t>(positions.cols());
  list.values.reserve(static_cast<std::size_t>(positions.size()));
  list.rows.reserve(static_cast<std::size_t>(positions.rows()));
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    if (!positions.row(i).allFinite()) continue;
    for (Eigen::Index k = 0; k < positions.cols(); ++k)
      list.values.push_back(static_cast<float>(positions(i, k)));
    list.rows.push_back(static_cast<std::uint32_t>(i));
  }
  tree_ = std::make_unique<Tree>(std::move(list));
}

NearestTexel::~NearestTexel() = default;
NearestTexel::NearestTexel(NearestTexel&&) noexcept = default;
NearestTexel& NearestTexel::operator=(NearestTexel&&) noexcept = default;

std::vector<std::uint32_t> NearestTexel::find(const Points& points) const {
  std::vector<std::uint32_t> nearest(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    std::array<float, remap::kLargestWarpDimension> query{};
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      query[static_cast<std::size_t>(k)] = static_cast<float>(points(i, k));
    std::uint32_t found = 0;
    float distance = 0.0f;
    tree_->index.knnSearch(query.data(), 1, &found, &distance);
    nearest[static_cast<std::size_t>(i)] = tree_->points.rows[found];
  }
  return nearest;
}

}  // namespace remapc
