#include "warp/features.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "warp/decompositions.hpp"

namespace remap {
namespace {

double node_width(Eigen::Index node) {
  const double share = static_cast<double>(node) / static_cast<double>(kWidthNodes - 1);
  return kLeastWidth * std::pow(kLargestWidth / kLeastWidth, share);
}

constexpr double kReferenceFloor =
    0.03;  // for darker reflectances, per steradian, differences are not amplified

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

Eigen::VectorXd mean_of(const MaterialRef& material, const std::vector<QuadratureDirection>& directions) {
  if (!material.is_separable()) return mean_of_samples(material);
  return mean_reflectance(*material.parametric(), lobe_table(material.parametric()->model, directions));
}

// Projects both tables onto the leading singular vectors of the space that both span.
FeaturePair separable_features(const WarpMaterial& source, const WarpMaterial& target,
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
  // The coordinates of the columns suffice. The left singular vectors are not needed.
  const auto [values, vectors] = symmetric_eigen(columns.transpose() * columns);
  const Eigen::VectorXd strengths = values.tail(kFeatureBasis).cwiseMax(0.0).cwiseSqrt();
  const Eigen::MatrixXd features = strengths.asDiagonal() * vectors.rightCols(kFeatureBasis).transpose();
  const auto part = [&](Eigen::Index first) {
    return SeparableFeatures{features.col(0), features.middleCols(first, nodes),
                             features.middleCols(first + nodes, nodes)};
  };
  return {part(1), part(is_one_model ? 1 : 1 + 2 * nodes)};
}

Eigen::VectorXd features_by(const SeparableFeatures& features, const WarpTexel& texel) {
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

Eigen::VectorXd features_by(const SampledFeatures& features, const WarpTexel& texel) {
  return features_of_samples(features, samples_of(features, texel));
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

Eigen::VectorXd direction_weights(const MaterialRef& source, const MaterialRef& target,
                                  AppearanceDistance distance) {
  const std::vector<QuadratureDirection> directions = half_vector_quadrature();
  const Eigen::VectorXd reference = 0.5 * (mean_of(source, directions) + mean_of(target, directions));
  return weights_of(directions, reference, distance);
}

FeaturePair appearance_features(const MaterialRef& source, const MaterialRef& target,
                                AppearanceDistance distance) {
  if (source.is_separable() && target.is_separable())
    return separable_features(*source.parametric(), *target.parametric(), distance);
  if (source.is_profiles() != target.is_profiles())
    throw input_error(source.name() + " and " + target.name() +
                      ": one contains scattering profiles and the other reflectance (both must be the same)");
  const Eigen::VectorXd weights =
      source.is_profiles() ? Eigen::VectorXd() : direction_weights(source, target, distance);
  return sampled_features(source, target, distance, weights);
}

Eigen::VectorXd features_of(const AppearanceFeatures& features, const WarpTexel& texel) {
  return std::visit([&](const auto& kind) { return features_by(kind, texel); }, features);
}

Eigen::MatrixXd feature_columns(const AppearanceFeatures& features, const MaterialRef& material,
                                const std::vector<std::uint32_t>& texels) {
  const auto of = [&](std::uint32_t texel) -> Eigen::VectorXd {
    if (const auto* sampled = std::get_if<SampledFeatures>(&features))
      return features_of_samples(*sampled, samples_of(*sampled, material, texel));
    return features_of(features, clamped(material.parametric()->texels[texel]));
  };
  Eigen::MatrixXd columns;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const Eigen::VectorXd own = of(texels[i]);
    if (i == 0) columns.resize(own.size(), static_cast<Eigen::Index>(texels.size()));
    columns.col(static_cast<Eigen::Index>(i)) = own;
  }
  return columns;
}

}  // namespace remap
