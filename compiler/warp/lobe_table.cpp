#include "warp/lobe_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace remap {
namespace {

double node_width(Eigen::Index node) {
  const double share = static_cast<double>(node) / static_cast<double>(kWidthNodes - 1);
  return kLeastWidth * std::pow(kLargestWidth / kLeastWidth, share);
}

}  // namespace

WidthPosition width_position(double alpha) noexcept {
  static const double start = std::log(kLeastWidth), length = std::log(kLargestWidth) - start;
  const double clamped = std::clamp(alpha, kLeastWidth, kLargestWidth);
  const double place = (std::log(clamped) - start) / length * static_cast<double>(kWidthNodes - 1);
  const double node = std::clamp(std::floor(place), 0.0, static_cast<double>(kWidthNodes - 2));
  return {static_cast<Eigen::Index>(node), place - node};
}

LobeTable lobe_table(const BrdfModel& model, const std::vector<QuadratureDirection>& directions) {
  const auto rows = static_cast<Eigen::Index>(directions.size());
  const auto columns = static_cast<Eigen::Index>(kWidthNodes);
  LobeTable table{Eigen::MatrixXd(rows, columns), Eigen::MatrixXd(rows, columns)};
  for (Eigen::Index node = 0; node < columns; ++node) {
    const double alpha = node_width(node);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const LocalGeometry& geometry = directions[static_cast<std::size_t>(i)].geometry;
      const Lobe lobe = evaluate_lobe(model.brdf, model.fresnel, alpha, geometry);
      table.slope(i, node) = lobe.slope;
      table.base(i, node) = lobe.base;
    }
  }
  return table;
}

Eigen::VectorXd mean_reflectance(const WarpMaterial& material, const LobeTable& table) {
  const std::vector<std::uint32_t> texels = sample_texels(material, kReferenceTexels);
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(table.slope.cols()), base = slope;
  double diffuse = 0.0;
  const auto mean = [](const WarpTexel& texel, std::size_t first) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) sum += static_cast<double>(texel[first + c]);
    return sum / 3.0;
  };
  for (const std::uint32_t index : texels) {
    const WarpTexel texel = clamped(material.texels[index]);
    const WidthPosition position = width_position(static_cast<double>(texel[6]));
    const double specular = mean(texel, 3);
    const auto add = [&](Eigen::Index node, double share) {
      slope[node] += share * specular;
      base[node] += share;
    };
    add(position.node, 1.0 - position.fraction);
    add(position.node + 1, position.fraction);
    diffuse += mean(texel, 0);
  }
  const Eigen::VectorXd sum = table.slope * slope + table.base * base;
  return (sum.array() + diffuse / std::numbers::pi) / static_cast<double>(texels.size());
}

}  // namespace remap
