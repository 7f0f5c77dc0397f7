// Appearance features: vectors whose Euclidean distance is that of two reflectances, whatever model or table
// they come from.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "warp/lobe_table.hpp"

namespace remapc {

// How the difference of two reflectances counts over directions (An et al. 2011, equation 1). kRelative
// divides it by the mean reflectance of both materials plus .03: rank correlation with differences of lit
// spheres .95 where the plain one has .58, which highlight peaks swamp. Both stay quadratic in reflectance.
// kCubeRoot and kLog compare its cube root and log(1 + rho / .05): .96, without a closed form.
enum class AppearanceDistance { kRelative, kPlain, kCubeRoot, kLog };

// `relative`, `plain`, `cube-root`, `log`; empty for other values.
std::string_view distance_name(AppearanceDistance distance);
std::optional<AppearanceDistance> distance_from_name(std::string_view name);
std::vector<std::string> distance_names();

inline constexpr Eigen::Index kFeatureBasis = 14;  // features of one channel; 3e-4 of the distance is lost

// Of parameters by a distance that is quadratic: one channel of a model, d diffuse + s slope(alpha) +
// base(alpha). Columns are nodes of alpha.
struct SeparableFeatures {
  Eigen::VectorXd diffuse;      // kFeatureBasis
  Eigen::MatrixXd slope, base;  // kFeatureBasis x kWidthNodes
};

// Of samples by any distance: directions of half_vector_quadrature(), or radii of profiles.
struct SampledFeatures {
  AppearanceDistance distance = AppearanceDistance::kRelative;
  std::vector<double> radii;  // those of both materials together; empty for reflectances
  Eigen::VectorXd weights;    // of the samples of one channel: square roots of what their differences count
  Eigen::MatrixXd basis;      // 3 x samples rows; orthonormal columns that span 512 texels of both materials
  LobeTable lobes;            // of parameters; empty for tables
  Eigen::VectorXd cosines;    // of dielectrics: between light and half vector at every direction; else empty
};

using AppearanceFeatures = std::variant<SeparableFeatures, SampledFeatures>;

// Both in one space.
struct FeaturePair {
  AppearanceFeatures source, target;
};

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
