#include "warp/features.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "named_values.hpp"
#include "warp/quadrature.hpp"

namespace remapc {
namespace {

constexpr remap::NamedValues<AppearanceDistance, 2> kDistances = {
    {{AppearanceDistance::kRelative, "relative"}, {AppearanceDistance::kPlain, "plain"}}};

constexpr std::size_t kReferenceTexels = 400;  // of each material
constexpr double kReferenceFloor = 0.03;       // reflectance per steradian that counts as dark

double node_width(Eigen::Index node) {
  const double share = static_cast<double>(node) / static_cast<double>(kWidthNodes - 1);
  return kLeastWidth * std::pow(kLargestWidth / kLeastWidth, share);
}

// Slope and base of a model at every direction (rows) and node of alpha (columns).
struct LobeTable {
  Eigen::MatrixXd slope, base;
};

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

// The mean reflectance of a material over its texels and channels, at every direction.
Eigen::VectorXd mean_reflectance(const WarpMaterial& material, const LobeTable& table) {
  const std::vector<remap::WarpTexel> texels = sample_texels(material, kReferenceTexels);
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(table.slope.cols()), base = slope;
  double diffuse = 0.0;
  const auto mean = [](const remap::WarpTexel& texel, std::size_t first) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) sum += static_cast<double>(texel[first + c]);
    return sum / 3.0;
  };
  for (const remap::WarpTexel& texel : texels) {
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

Eigen::VectorXd weights_of(const std::vector<QuadratureDirection>& directions,
                           const Eigen::VectorXd& reference, AppearanceDistance distance) {
  Eigen::VectorXd weights(reference.size());
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const double weight = directions[static_cast<std::size_t>(i)].weight;
    const bool is_relative = distance == AppearanceDistance::kRelative;
    weights[i] = std::sqrt(weight) / (is_relative ? reference[i] + kReferenceFloor : 1.0);
  }
  return weights;
}

}  // namespace

std::string_view distance_name(AppearanceDistance distance) { return remap::name_of(kDistances, distance); }
std::optional<AppearanceDistance> distance_from_name(std::string_view name) {
  return remap::value_named(kDistances, name);
}
std::vector<std::string> distance_names() { return remap::names_of(kDistances); }

WidthPosition width_position(double alpha) noexcept {
  static const double start = std::log(kLeastWidth), length = std::log(kLargestWidth) - start;
  const double held = std::clamp(alpha, kLeastWidth, kLargestWidth);
  const double place = (std::log(held) - start) / length * static_cast<double>(kWidthNodes - 1);
  const double node = std::clamp(std::floor(place), 0.0, static_cast<double>(kWidthNodes - 2));
  return {static_cast<Eigen::Index>(node), place - node};
}

std::vector<remap::WarpTexel> sample_texels(const WarpMaterial& material, std::size_t limit) {
  std::vector<remap::WarpTexel> texels;
  const std::size_t count = material.texels.size(), wanted = std::min(limit, count);
  texels.reserve(wanted);
  for (std::size_t i = 0; i < wanted; ++i) {
    // Scattered within each step, so that samples do not stand in columns.
    const std::size_t step = count / wanted;
    const remap::WarpTexel& texel = material.texels[i * count / wanted + i * 61 % step];
    if (is_finite(texel)) texels.push_back(texel);
  }
  if (texels.empty())  // finite texels are rare
    std::copy_if(material.texels.begin(), material.texels.end(), std::back_inserter(texels), is_finite);
  return texels;
}

Eigen::VectorXd direction_weights(const WarpMaterial& source, const WarpMaterial& target,
                                  AppearanceDistance distance) {
  const std::vector<QuadratureDirection> directions = half_vector_quadrature();
  const Eigen::VectorXd reference = 0.5 * (mean_reflectance(source, lobe_table(source.model, directions)) +
                                           mean_reflectance(target, lobe_table(target.model, directions)));
  return weights_of(directions, reference, distance);
}

FeaturePair appearance_features(const WarpMaterial& source, const WarpMaterial& target,
                                AppearanceDistance distance) {
  const std::vector<QuadratureDirection> directions = half_vector_quadrature();
  const LobeTable source_table = lobe_table(source.model, directions);
  const bool is_one_model = source.model == target.model;
  const LobeTable target_table = is_one_model ? source_table : lobe_table(target.model, directions);
  const Eigen::VectorXd reference =
      0.5 * (mean_reflectance(source, source_table) + mean_reflectance(target, target_table));
  const Eigen::VectorXd weights = weights_of(directions, reference, distance);

  const Eigen::Index nodes = source_table.slope.cols();
  Eigen::MatrixXd columns(weights.size(), 1 + (is_one_model ? 2 : 4) * nodes);
  columns.col(0).setConstant(1.0 / std::numbers::pi);
  columns.middleCols(1, nodes) = source_table.slope;
  columns.middleCols(1 + nodes, nodes) = source_table.base;
  if (!is_one_model) {
    columns.middleCols(1 + 2 * nodes, nodes) = target_table.slope;
    columns.middleCols(1 + 3 * nodes, nodes) = target_table.base;
  }
  columns = weights.asDiagonal() * columns;
  // The left singular vectors are not needed, only what the columns are in them.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(columns.transpose() * columns);
  const Eigen::VectorXd strengths = solver.eigenvalues().tail(kFeatureBasis).cwiseMax(0.0).cwiseSqrt();
  const Eigen::MatrixXd features =
      strengths.asDiagonal() * solver.eigenvectors().rightCols(kFeatureBasis).transpose();
  const auto part = [&](Eigen::Index first) {
    return SeparableFeatures{features.col(0), features.middleCols(first, nodes),
                             features.middleCols(first + nodes, nodes)};
  };
  return {part(1), part(is_one_model ? 1 : 1 + 2 * nodes)};
}

Eigen::VectorXd features_of(const SeparableFeatures& features, const remap::WarpTexel& texel) {
  const WidthPosition position = width_position(static_cast<double>(texel[6]));
  const auto between = [&](const Eigen::MatrixXd& table) -> Eigen::Matrix<double, kFeatureBasis, 1> {
    return (1.0 - position.fraction) * table.col(position.node) +
           position.fraction * table.col(position.node + 1);
  };
  const Eigen::Matrix<double, kFeatureBasis, 1> slope = between(features.slope),
                                                base = between(features.base);
  Eigen::VectorXd result(3 * kFeatureBasis);
  for (Eigen::Index c = 0; c < 3; ++c) {
    const double diffuse = static_cast<double>(texel[static_cast<std::size_t>(c)]);
    const double specular = static_cast<double>(texel[static_cast<std::size_t>(3 + c)]);
    result.segment(c * kFeatureBasis, kFeatureBasis) = diffuse * features.diffuse + specular * slope + base;
  }
  return result;
}

}  // namespace remapc
