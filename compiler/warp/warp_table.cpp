#include "warp/warp_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <nanoflann.hpp>

#include "core/errors.hpp"
#include "warp/registration.hpp"

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

void set_box(ParameterTable& table, const Points& positions) {
  for (Eigen::Index k = 0; k < positions.cols(); ++k) {
    const auto [low, high] = extent_of(positions, k);
    // Axes without extent get a margin.
    const double margin = std::max(1e-3 - 0.5 * (high - low), 0.0);
    table.low.push_back(static_cast<float>(low - margin));
    table.high.push_back(static_cast<float>(high + margin));
  }
}

// Returns the number of nodes in the whole box.
std::size_t node_count(const ParameterTable& table) {
  std::size_t count = 1;
  for (std::size_t k = 0; k < table.low.size(); ++k) count *= table.nodes;
  return count;
}

// Returns the positions of the nodes along one axis.
Eigen::VectorXd axis_nodes(const ParameterTable& table, std::size_t axis) {
  return Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(table.nodes),
                                    static_cast<double>(table.low[axis]),
                                    static_cast<double>(table.high[axis]));
}

Points node_positions(const ParameterTable& table) {
  const std::size_t dimension = table.low.size(), count = node_count(table);
  Points positions(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(dimension));
  std::size_t run = 1;
  for (std::size_t k = 0; k < dimension; ++k, run *= table.nodes) {
    const Eigen::VectorXd axis = axis_nodes(table, k);
    for (std::size_t i = 0; i < count; ++i)
      positions(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          axis[static_cast<Eigen::Index>(i / run % table.nodes)];
  }
  return positions;
}

// The Gaussians take most of the time of a table. On a grid, they are products of one factor per axis, which
// is faster.
Points images_of_nodes(const SmoothWarp& warp, const ParameterTable& table) {
  const std::size_t dimension = table.low.size();
  Points images = images_of(warp.affine, node_positions(table));
  std::vector<Eigen::MatrixXd> factors;  // nodes x centres, for each axis
  for (std::size_t k = 0; k < dimension; ++k)
    factors.push_back(
        gaussians(axis_nodes(table, k), warp.centres.col(static_cast<Eigen::Index>(k)), warp.width));
  const auto run = static_cast<Eigen::Index>(table.nodes);
  for (Eigen::Index start = 0; start < images.rows(); start += run) {
    Eigen::RowVectorXd factor = Eigen::RowVectorXd::Ones(warp.centres.rows());
    Eigen::Index rest = start / run;
    for (std::size_t k = 1; k < dimension; ++k, rest /= run)
      factor.array() *= factors[k].row(rest % run).array();
    images.middleRows(start, run) += factors[0] * (factor.transpose().asDiagonal() * warp.weights);
  }
  return images;
}

std::uint8_t encoded(float value, float least, float largest) {
  if (!(largest > least)) return 0;
  const float share = std::clamp((value - least) / (largest - least), 0.0f, 1.0f);
  return static_cast<std::uint8_t>(std::lround(255.0f * std::sqrt(share)));
}

BlendedNodes blended_nodes(const std::vector<std::uint32_t>& texels, const WarpMaterial& target) {
  BlendedNodes entries;
  entries.codes.resize(texels.size() * kWarpParameters);
  for (std::size_t p = 0; p < kWarpParameters; ++p) {
    entries.least[p] = entries.largest[p] = target.texels[texels[0]][p];
    for (const std::uint32_t texel : texels) {
      entries.least[p] = std::min(entries.least[p], target.texels[texel][p]);
      entries.largest[p] = std::max(entries.largest[p], target.texels[texel][p]);
    }
    for (std::size_t i = 0; i < texels.size(); ++i)
      entries.codes[i * kWarpParameters + p] =
          encoded(target.texels[texels[i]][p], entries.least[p], entries.largest[p]);
  }
  return entries;
}

// Builds the palette, without duplicate texels.
CopiedNodes copied_nodes(const std::vector<std::uint32_t>& texels, const WarpMaterial& target) {
  CopiedNodes entries;
  entries.indices.reserve(texels.size());
  std::map<WarpTexel, std::size_t> known;
  for (const std::uint32_t texel : texels) {
    const auto [place, is_new] = known.try_emplace(target.texels[texel], known.size());
    if (is_new) entries.palette.push_back(place->first);
    entries.indices.push_back(static_cast<std::uint16_t>(place->second));
  }
  if (known.size() > kLargestPalette)
    throw usage_error("--exact: the table needs " + std::to_string(known.size()) + " texels of " +
                      target.name + ", more than " + std::to_string(kLargestPalette) + " (remove --exact)");
  return entries;
}

constexpr std::uint32_t kUnknown = ~std::uint32_t{0};

// Returns the nodes around every position and their neighbors, in increasing order. Source texels look up
// these nodes, even if `positions` are only a sample of the texels.
std::vector<std::uint32_t> nodes_around(const Points& positions, const ParameterTable& table) {
  const std::size_t dimension = table.low.size(), nodes = table.nodes, count = node_count(table);
  std::vector<char> is_near(count, 0);
  const auto last = static_cast<double>(nodes - 1);
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    std::array<std::size_t, kLargestWarpDimension> first{};
    for (std::size_t k = 0; k < dimension; ++k) {
      const double low = static_cast<double>(table.low[k]), high = static_cast<double>(table.high[k]);
      const double place = (positions(i, static_cast<Eigen::Index>(k)) - low) / (high - low) * last;
      first[k] = static_cast<std::size_t>(std::clamp(place, 0.0, last - 1.0));  // `place` is not NaN here
    }
    std::size_t run = 1, cell = 0;
    for (std::size_t k = 0; k < dimension; ++k, run *= nodes) cell += first[k] * run;
    is_near[cell] = 1;
  }
  // A cell is marked at its first node. Its corners and their neighbours are the nodes from one step before
  // this node to two steps after it.
  std::size_t run = 1;
  for (std::size_t k = 0; k < dimension; ++k, run *= nodes) {
    const std::vector<char> before = is_near;
    for (std::size_t node = 0; node < count; ++node) {
      if (before[node] == 0) continue;
      const std::size_t place = node / run % nodes;
      if (place > 0) is_near[node - run] = 1;
      for (std::size_t up = 1; up <= 2 && place + up < nodes; ++up) is_near[node + up * run] = 1;
    }
  }
  std::vector<std::uint32_t> found;
  for (std::size_t node = 0; node < count; ++node)
    if (is_near[node] != 0) found.push_back(static_cast<std::uint32_t>(node));
  return found;
}

// Gives every unknown node the texel of the known node that is the fewest steps away.
void spread(std::vector<std::uint32_t>& texels, std::vector<std::uint32_t> front, std::size_t nodes) {
  while (!front.empty()) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t node : front)
      for (std::size_t run = 1; run < texels.size(); run *= nodes) {
        const std::size_t place = node / run % nodes;
        const auto reach = [&](std::size_t other) {
          if (texels[other] != kUnknown) return;
          texels[other] = texels[node];
          next.push_back(static_cast<std::uint32_t>(other));
        };
        if (place > 0) reach(node - run);
        if (place + 1 < nodes) reach(node + run);
      }
    front = std::move(next);
  }
}

// Finds the texel closest to the image of every node that source texels look up. The remaining nodes, often
// most of the box, copy the result of the closest of these nodes, because the warp is undefined far from the
// source.
std::vector<std::uint32_t> node_texels(const Points& positions, const ParameterTable& table,
                                       const Points& images, const Points& target_positions) {
  const std::vector<std::uint32_t> near = nodes_around(positions, table);
  const std::vector<std::uint32_t> found = nearest_texels(target_positions, images(near, Eigen::all));
  std::vector<std::uint32_t> texels(static_cast<std::size_t>(images.rows()), kUnknown);
  for (std::size_t i = 0; i < near.size(); ++i) texels[near[i]] = found[i];
  spread(texels, near, table.nodes);
  return texels;
}

std::size_t nodes_of(Eigen::Index dimension, bool exact) noexcept {
  if (dimension == 1) return exact ? 4096 : 1024;
  if (dimension == 2) return exact ? 256 : 128;
  return exact ? 48 : 32;
}

}  // namespace

std::vector<std::uint32_t> nearest_texels(const Points& positions, const Points& points) {
  if (positions.cols() == 1) return Tree<1>(positions).find(points);
  if (positions.cols() == 2) return Tree<2>(positions).find(points);
  return Tree<3>(positions).find(points);
}

ParameterTable compile_table(const SmoothWarp& warp, const Points& positions, const Points& target_positions,
                             const WarpMaterial& target, bool exact) {
  ParameterTable table;
  table.nodes = nodes_of(positions.cols(), exact);
  set_box(table, positions);
  const std::vector<std::uint32_t> texels =
      node_texels(positions, table, images_of_nodes(warp, table), target_positions);
  if (exact)
    table.entries = copied_nodes(texels, target);
  else
    table.entries = blended_nodes(texels, target);
  return table;
}

}  // namespace remap
