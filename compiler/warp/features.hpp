// Appearance features: vectors whose Euclidean distance is that of two reflectances, whatever model they come
// from.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "warp/material.hpp"

namespace remapc {

// How the squared difference of two reflectances counts over directions (An et al. 2011, equation 1).
// kRelative divides differences by the mean reflectance of both materials plus .03: rank correlation with
// differences of lit spheres .95 where the plain one has .58, which highlight peaks swamp. Both stay
// quadratic, so that features exist.
enum class AppearanceDistance { kRelative, kPlain };

// `relative`, `plain`; empty for other values.
std::string_view distance_name(AppearanceDistance distance);
std::optional<AppearanceDistance> distance_from_name(std::string_view name);
std::vector<std::string> distance_names();

inline constexpr std::size_t kWidthNodes = 64;  // even in log(alpha) between these
inline constexpr double kLeastWidth = 0.04, kLargestWidth = 1.0;
inline constexpr Eigen::Index kFeatureBasis = 14;  // features of one channel; 3e-4 of the distance is lost

// The features of one channel of a model, d diffuse + s slope(alpha) + base(alpha): columns are nodes of
// alpha.
struct SeparableFeatures {
  Eigen::VectorXd diffuse;      // kFeatureBasis
  Eigen::MatrixXd slope, base;  // kFeatureBasis x kWidthNodes
};

// Both in one space.
struct FeaturePair {
  SeparableFeatures source, target;
};

FeaturePair appearance_features(const WarpMaterial& source, const WarpMaterial& target,
                                AppearanceDistance distance = AppearanceDistance::kRelative);

// 3 kFeatureBasis numbers, channel by channel.
Eigen::VectorXd features_of(const SeparableFeatures& features, const remap::WarpTexel& texel);

// Texels whose values are finite, at most `limit`, evenly spread over the list.
std::vector<remap::WarpTexel> sample_texels(const WarpMaterial& material, std::size_t limit);

// Between which two nodes an alpha lies, and how far: `fraction` from 0 to 1.
struct WidthPosition {
  Eigen::Index node = 0;
  double fraction = 0.0;
};
WidthPosition width_position(double alpha) noexcept;

// The square roots of the weights of the directions of half_vector_quadrature() for `distance`: what features
// are compressed from, and what they can be checked against.
Eigen::VectorXd direction_weights(const WarpMaterial& source, const WarpMaterial& target,
                                  AppearanceDistance distance);

}  // namespace remapc
