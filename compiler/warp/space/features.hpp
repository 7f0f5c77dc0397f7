// Appearance features: vectors whose Euclidean distance is that of two reflectances, whatever model or table
// they come from.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "warp/space/appearance_features.hpp"

namespace remapc {

// `relative`, `plain`, `cube-root`, `log`; empty for other values.
std::string_view distance_name(AppearanceDistance distance);
std::optional<AppearanceDistance> distance_from_name(std::string_view name);
std::vector<std::string> distance_names();

// Closed forms where both materials are parametric and the distance is quadratic; by samples elsewhere.
// Throws kInput for profiles beside reflectances, kUsage for profiles by the relative distance, whose floor
// is a reflectance.
FeaturePair appearance_features(const MaterialRef& source, const MaterialRef& target,
                                AppearanceDistance distance = AppearanceDistance::kRelative);

// Of parameters: 3 kFeatureBasis numbers, channel by channel, or as many as the basis has columns.
Eigen::VectorXd features_of(const AppearanceFeatures& features, const remap::WarpTexel& texel);

// Of texels that take part, a column each.
Eigen::MatrixXd feature_columns(const AppearanceFeatures& features, const MaterialRef& material,
                                const std::vector<std::uint32_t>& texels);

// The square roots of the weights of the directions of half_vector_quadrature() for `distance`: what features
// are compressed from, and what they can be checked against. Of reflectances.
Eigen::VectorXd direction_weights(const MaterialRef& source, const MaterialRef& target,
                                  AppearanceDistance distance);

}  // namespace remapc
