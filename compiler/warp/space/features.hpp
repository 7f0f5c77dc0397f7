// Computes appearance features: vectors whose Euclidean distance is the appearance distance of two
// reflectances, for any model or table.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "warp/space/appearance_features.hpp"

namespace remapc {

// The names are `relative`, `plain`, `cube-root` and `log`; empty for another name.
std::optional<AppearanceDistance> distance_from_name(std::string_view name);
std::vector<std::string> distance_names();

// Uses closed forms if both materials are parametric and the distance is quadratic, samples otherwise. Throws
// kInput if only one of the materials has profiles, and kUsage for profiles with the relative distance, which
// is defined for reflectances only.
FeaturePair appearance_features(const MaterialRef& source, const MaterialRef& target,
                                AppearanceDistance distance = AppearanceDistance::kRelative);

// The features of a parametric texel: 3 * kFeatureBasis numbers, channel by channel, or one number per column
// of the sampled basis.
Eigen::VectorXd features_of(const AppearanceFeatures& features, const remap::WarpTexel& texel);

// The features of `texels`, one column per texel. All of them must be finite or in the table.
Eigen::MatrixXd feature_columns(const AppearanceFeatures& features, const MaterialRef& material,
                                const std::vector<std::uint32_t>& texels);

// The square roots of the weights of the directions of half_vector_quadrature() for `distance` between
// reflectances. Features are compressed from these weighted samples and can be tested against them.
Eigen::VectorXd direction_weights(const MaterialRef& source, const MaterialRef& target,
                                  AppearanceDistance distance);

}  // namespace remapc
