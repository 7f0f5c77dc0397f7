#include "warp/coordinates.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "error.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

constexpr std::size_t kSampledTexels = 16384;
constexpr std::size_t kStressPairs = 4096;
constexpr double kStressGoal = 0.03;
constexpr double kLeastRadius = 1e-3;

Eigen::MatrixXd feature_columns(const std::vector<remap::WarpTexel>& texels,
                                const SeparableFeatures& features) {
  Eigen::MatrixXd columns(3 * kFeatureBasis, static_cast<Eigen::Index>(texels.size()));
  for (std::size_t i = 0; i < texels.size(); ++i)
    columns.col(static_cast<Eigen::Index>(i)) = features_of(features, texels[i]);
  return columns;
}

// `columns`: centred features.
std::array<double, 3> stress_of(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& axes) {
  std::array<double, 3> error{};
  double total = 0.0;
  const auto count = static_cast<std::size_t>(columns.cols());
  for (std::size_t i = 0; i < kStressPairs; ++i) {
    // Pairs from all over the list, by multiplicative hashes.
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

}  // namespace

AppearanceSpace appearance_space(const WarpMaterial& material, const SeparableFeatures& features) {
  Eigen::MatrixXd columns = feature_columns(sample_texels(material, kSampledTexels), features);
  const auto count = static_cast<double>(columns.cols());
  AppearanceSpace space;
  space.mean = columns.rowwise().mean();
  columns.colwise() -= space.mean;
  const Eigen::MatrixXd covariance = columns * columns.transpose() / count;
  space.radius = std::sqrt(covariance.trace());
  if (!(space.radius > kLeastRadius * space.mean.norm()))
    throw Error(ErrorKind::kInput, material.name +
                                       ": all texels look alike; expected a material with at least two "
                                       "appearances (of one appearance there is nothing to warp)");
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  space.axes = solver.eigenvectors().rightCols(3).rowwise().reverse();
  space.stress = stress_of(columns, space.axes);
  return space;
}

int dimension_of(const AppearanceSpace& space) {
  for (std::size_t n = 1; n < space.stress.size(); ++n)
    if (space.stress[n - 1] < kStressGoal) return static_cast<int>(n);
  return static_cast<int>(space.stress.size());
}

remap::AppearanceCoordinates closed_form(const AppearanceSpace& space, const SeparableFeatures& features,
                                         int dimension) {
  remap::AppearanceCoordinates result;
  result.dimension = static_cast<std::size_t>(dimension);
  result.least_alpha = static_cast<float>(kLeastWidth);
  result.largest_alpha = static_cast<float>(kLargestWidth);
  remap::SeparableTerms terms;
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

Points positions_of(const remap::AppearanceCoordinates& coordinates,
                    const std::vector<remap::WarpTexel>& texels) {
  const auto dimension = static_cast<Eigen::Index>(coordinates.dimension);
  Points positions(static_cast<Eigen::Index>(texels.size()), dimension);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const auto position = remap::coordinates_of(coordinates, texels[i]);
    for (Eigen::Index k = 0; k < dimension; ++k)
      positions(static_cast<Eigen::Index>(i), k) = position[static_cast<std::size_t>(k)];
  }
  return positions;
}

}  // namespace remapc
