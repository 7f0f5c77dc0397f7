// This file computes appearance features. These are vectors, and their Euclidean distance is the appearance
// distance of two reflectances. They exist for any model or table. features.cpp tabulates the specular lobe
// of a model over directions and alpha, and has closed formulas. sampled_features.cpp has features from
// samples.
#pragma once

#include <variant>
#include <vector>

#include <Eigen/Core>

#include "remap/model.hpp"
#include "warp/material.hpp"
#include "warp/quadrature.hpp"

namespace remap {

inline constexpr std::size_t kWidthNodes = 64;  // uniform in log(alpha) between kLeastWidth and kLargestWidth
inline constexpr double kLeastWidth = 0.04, kLargestWidth = 1.0;

// A WidthPosition is the position of an alpha between `node` and the next node. `fraction` is 0 to 1.
struct WidthPosition {
  Eigen::Index node = 0;
  double fraction = 0.0;
};
WidthPosition width_position(double alpha) noexcept;

// A LobeTable holds slope and base of a model (Lobe in brdf.hpp) by direction (row) and node of alpha
// (column).
struct LobeTable {
  Eigen::MatrixXd slope, base;
};
LobeTable lobe_table(const BrdfModel& model, const std::vector<QuadratureDirection>& directions);

inline constexpr std::size_t kReferenceTexels = 400;

// Returns a material's mean reflectance over kReferenceTexels texels and all channels, by direction.
Eigen::VectorXd mean_reflectance(const WarpMaterial& material, const LobeTable& table);

// An AppearanceDistance is the weight of differences between two reflectances over directions (An et al.
// 2011, equation 1). kRelative divides a difference by the mean reflectance of both materials plus 0.03. Its
// rank correlation with differences of lit spheres is 0.95. For kPlain it is 0.58, because highlight peaks
// dominate.
enum class AppearanceDistance { kRelative, kPlain };
inline constexpr NamedValues<AppearanceDistance, 2> kAppearanceDistances = {
    {{AppearanceDistance::kRelative, "relative"}, {AppearanceDistance::kPlain, "plain"}}};

inline constexpr Eigen::Index kFeatureBasis = 14;  // features per channel; the error is 3e-4 of the distance

// A SeparableFeatures holds features of parameters whose lobes are linear in diffuse and specular. The
// features of one channel are d * diffuse + s * slope(alpha) + base(alpha), where d is diffuse and s
// specular. Columns are nodes of alpha.
struct SeparableFeatures {
  Eigen::VectorXd diffuse;      // kFeatureBasis values
  Eigen::MatrixXd slope, base;  // kFeatureBasis x kWidthNodes
};

// A SampledFeatures holds features from samples of reflectance. They are for tables and for exact Fresnel
// reflectance. Samples are at the directions of half_vector_quadrature(), or at the radii of profiles.
struct SampledFeatures {
  std::vector<double> radii;  // radii of both materials; empty for reflectances
  Eigen::VectorXd weights;    // square roots of the weights of the samples of one channel
  Eigen::MatrixXd basis;      // 3 x samples rows; orthonormal columns that span 512 texels
  LobeTable lobes;            // for parametric materials; empty for tables
  Eigen::VectorXd cosines;    // cosine between light and half vector; dielectrics only
};

using AppearanceFeatures = std::variant<SeparableFeatures, SampledFeatures>;

// A FeaturePair holds the features of both materials in one space.
struct FeaturePair {
  AppearanceFeatures source, target;
};

// Uses closed forms if both materials are parametric and have no exact Fresnel reflectance. Otherwise it uses
// samples. Throws kInput if only one of the materials has profiles. Throws kUsage for profiles with the
// relative distance, which is only defined for reflectances.
FeaturePair appearance_features(const MaterialRef& source, const MaterialRef& target,
                                AppearanceDistance distance = AppearanceDistance::kRelative);

// Returns the features of a parametric texel: 3 * kFeatureBasis numbers, channel by channel, or one number
// per column of the sampled basis.
Eigen::VectorXd features_of(const AppearanceFeatures& features, const WarpTexel& texel);

// Returns the features of `texels`, one column per texel. All of them must be finite or in the table.
Eigen::MatrixXd feature_columns(const AppearanceFeatures& features, const MaterialRef& material,
                                const std::vector<std::uint32_t>& texels);

// Returns the square roots of the weights of the directions of half_vector_quadrature(). They belong to
// `distance` between reflectances. Features are compressed from samples with these weights, so tests compare
// them with such samples.
Eigen::VectorXd direction_weights(const MaterialRef& source, const MaterialRef& target,
                                  AppearanceDistance distance);

// Returns the samples of a texel that SampledFeatures compares. These are the reflectance at every direction,
// or the profile at every radius, of red, green and blue.
Eigen::VectorXd samples_of(const SampledFeatures& features, const WarpTexel& texel);
Eigen::VectorXd samples_of(const SampledFeatures& features, const TabulatedMaterial& material,
                           std::uint32_t entry);
Eigen::VectorXd samples_of(const SampledFeatures& features, const MaterialRef& material, std::uint32_t texel);
Eigen::VectorXd features_of_samples(const SampledFeatures& features, const Eigen::VectorXd& samples);

// Does the work of appearance_features() for SampledFeatures. `weights` are direction_weights(), which
// profiles do not need.
FeaturePair sampled_features(const MaterialRef& source, const MaterialRef& target,
                             AppearanceDistance distance, const Eigen::VectorXd& weights);

// Returns the mean reflectance at every direction, over kReferenceTexels texels and all channels.
Eigen::VectorXd mean_of_samples(const MaterialRef& material);

}  // namespace remap
