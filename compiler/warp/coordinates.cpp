#include "warp/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/errors.hpp"
#include "warp/decompositions.hpp"

namespace remap {
namespace {

constexpr std::size_t kSampledTexels = 16384;
constexpr std::size_t kStressPairs = 4096;
constexpr std::size_t kSlowTexels = 4096;  // features by samples use at most this many texels
constexpr double kFitRidge = 1e-9;         // relative to the mean square of the terms
constexpr double kStressGoal = 0.03;
constexpr double kLeastRadius = 1e-3;

// Computes the stress of 1, 2 and 3 dimensions. `columns` are centred features.
std::array<double, 3> stress_of(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& axes) {
  std::array<double, 3> error{};
  double total = 0.0;
  const auto count = static_cast<std::size_t>(columns.cols());
  for (std::size_t i = 0; i < kStressPairs; ++i) {
    // Multiplicative hashes pick pairs of texels from the whole list.
    const auto first = static_cast<Eigen::Index>(i * 2654435761u % count);
    const auto second = static_cast<Eigen::Index>((i * 2246822519u + 97u) % count);
    const Eigen::VectorXd difference = columns.col(first) - columns.col(second);
    const double distance = difference.norm();
    const Eigen::VectorXd seen = axes.transpose() * difference;
    for (std::size_t n = 0; n < error.size(); ++n)
      error[n] += std::pow(distance - seen.head(static_cast<Eigen::Index>(n) + 1).norm(), 2.0);
    total += distance * distance;
  }
  for (double& sum : error) sum = total > 0.0 ? std::sqrt(sum / total) : 0.0;
  return error;
}

AppearanceCoordinates coordinates_without_terms(int dimension) {
  AppearanceCoordinates coordinates;
  coordinates.dimension = static_cast<std::size_t>(dimension);
  coordinates.least_alpha = static_cast<float>(kLeastWidth);
  coordinates.largest_alpha = static_cast<float>(kLargestWidth);
  return coordinates;
}

// Fits the 36 terms of texels by ridge regression.
Placement fitted(const WarpMaterial& material, const AppearanceFeatures& features,
                 const AppearanceSpace& space, int dimension) {
  const std::vector<std::uint32_t> texels = sample_texels(material, kSlowTexels);
  const Points goal = projected(space, feature_columns(features, material, texels), dimension);
  AppearanceCoordinates result = coordinates_without_terms(dimension);
  constexpr auto kTerms = static_cast<Eigen::Index>(kQuadraticTerms);
  Eigen::MatrixXd design(goal.rows(), kTerms);
  for (Eigen::Index i = 0; i < design.rows(); ++i) {
    const auto terms = quadratic_terms(result, clamped(material.texels[texels[static_cast<std::size_t>(i)]]));
    design.row(i) = Eigen::Map<const Eigen::RowVectorXd>(terms.data(), kTerms);
  }
  Eigen::MatrixXd left = design.transpose() * design;
  left.diagonal().array() += kFitRidge * left.trace() / static_cast<double>(kTerms);
  const Eigen::MatrixXd weights = solve_symmetric(left, design.transpose() * goal);
  QuadraticTerms terms;
  for (Eigen::Index k = 0; k < dimension; ++k)
    for (Eigen::Index t = 0; t < kTerms; ++t) terms.weights.push_back(static_cast<float>(weights(t, k)));
  result.terms = std::move(terms);
  return {std::move(result), std::sqrt((design * weights - goal).rowwise().squaredNorm().mean())};
}

}  // namespace

AppearanceSpace appearance_space(const MaterialRef& material, const AppearanceFeatures& features) {
  const bool is_slow = std::holds_alternative<SampledFeatures>(features);
  const std::size_t limit = is_slow ? kSlowTexels : kSampledTexels;
  Eigen::MatrixXd columns = feature_columns(features, material, sample_texels(material, limit));
  const auto count = static_cast<double>(columns.cols());
  AppearanceSpace space;
  space.mean = columns.rowwise().mean();
  columns.colwise() -= space.mean;
  const Eigen::MatrixXd covariance = columns * columns.transpose() / count;
  space.radius = std::sqrt(covariance.trace());
  if (!(space.radius > kLeastRadius * space.mean.norm()))
    throw input_error(material.name() +
                      ": all texels look the same (a warp needs a material with at least two appearances)");
  // With fewer than three features, the remaining axes are 0.
  const Eigen::Index found = std::min<Eigen::Index>(3, columns.rows());
  space.axes = Eigen::MatrixXd::Zero(columns.rows(), 3);
  space.axes.leftCols(found) = symmetric_eigen(covariance).vectors.rightCols(found).rowwise().reverse();
  space.stress = stress_of(columns, space.axes);
  return space;
}

Points projected(const AppearanceSpace& space, const Eigen::MatrixXd& columns, int dimension) {
  return (columns.colwise() - space.mean).transpose() * space.axes.leftCols(dimension) / space.radius;
}

int dimension_of(const AppearanceSpace& space) {
  for (std::size_t n = 1; n < space.stress.size(); ++n)
    if (space.stress[n - 1] < kStressGoal) return static_cast<int>(n);
  return static_cast<int>(space.stress.size());
}

AppearanceCoordinates closed_form(const AppearanceSpace& space, const SeparableFeatures& features,
                                  int dimension) {
  AppearanceCoordinates result = coordinates_without_terms(dimension);
  SeparableTerms terms;
  terms.specular.resize(kWidthNodes * result.dimension * 3);
  terms.offset.resize(kWidthNodes * result.dimension);
  terms.diffuse.resize(result.dimension * 3);
  for (std::size_t k = 0; k < result.dimension; ++k) {
    const Eigen::VectorXd axis = space.axes.col(static_cast<Eigen::Index>(k)) / space.radius;
    const auto channel = [&](std::size_t c) {
      return axis.segment(static_cast<Eigen::Index>(c) * kFeatureBasis, kFeatureBasis);
    };
    const Eigen::VectorXd all_channels = channel(0) + channel(1) + channel(2);
    for (std::size_t c = 0; c < 3; ++c)
      terms.diffuse[3 * k + c] = static_cast<float>(channel(c).dot(features.diffuse));
    for (std::size_t node = 0; node < kWidthNodes; ++node) {
      const auto column = static_cast<Eigen::Index>(node);
      const std::size_t place = node * result.dimension + k;
      terms.offset[place] =
          static_cast<float>(all_channels.dot(features.base.col(column)) - axis.dot(space.mean));
      for (std::size_t c = 0; c < 3; ++c)
        terms.specular[3 * place + c] = static_cast<float>(channel(c).dot(features.slope.col(column)));
    }
  }
  result.terms = std::move(terms);
  return result;
}

Points positions_of(const AppearanceCoordinates& coordinates, const std::vector<WarpTexel>& texels) {
  const auto dimension = static_cast<Eigen::Index>(coordinates.dimension);
  Points positions(static_cast<Eigen::Index>(texels.size()), dimension);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const auto position = coordinates_of(coordinates, texels[i]);
    for (Eigen::Index k = 0; k < dimension; ++k)
      positions(static_cast<Eigen::Index>(i), k) = position[static_cast<std::size_t>(k)];
  }
  return positions;
}

Placement placement_of(const MaterialRef& material, const AppearanceFeatures& features,
                       const AppearanceSpace& space, int dimension) {
  if (const auto* separable = std::get_if<SeparableFeatures>(&features))
    return {closed_form(space, *separable, dimension)};
  if (material.parametric() != nullptr) return fitted(*material.parametric(), features, space, dimension);
  const auto& sampled = std::get<SampledFeatures>(features);
  const Eigen::Index entries = material.tabulated()->samples.cols();
  Eigen::MatrixXd columns(sampled.basis.cols(), entries);
  for (Eigen::Index entry = 0; entry < entries; ++entry)
    columns.col(entry) = features_of_samples(
        sampled, samples_of(sampled, *material.tabulated(), static_cast<std::uint32_t>(entry)));
  return {projected(space, columns, dimension)};
}

Points positions_of(const Placement& placement, const MaterialRef& material,
                    const std::vector<std::uint32_t>& texels) {
  const auto* entries = std::get_if<Points>(&placement.coordinates);
  if (entries == nullptr) {
    std::vector<WarpTexel> values;
    values.reserve(texels.size());
    for (const std::uint32_t texel : texels) values.push_back(material.parametric()->texels[texel]);
    return positions_of(std::get<AppearanceCoordinates>(placement.coordinates), values);
  }
  Points positions(static_cast<Eigen::Index>(texels.size()), entries->cols());
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const auto entry = static_cast<Eigen::Index>(material.tabulated()->entries[texels[i]]);
    if (entry < entries->rows())
      positions.row(row) = entries->row(entry);
    else
      positions.row(row).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return positions;
}

Points positions_of(const Placement& placement, const MaterialRef& material) {
  if (material.parametric() != nullptr)
    return positions_of(std::get<AppearanceCoordinates>(placement.coordinates),
                        material.parametric()->texels);
  std::vector<std::uint32_t> all(material.texel_count());
  std::iota(all.begin(), all.end(), 0u);
  return positions_of(placement, material, all);
}

}  // namespace remap
