// Appearance features: in closed form or by samples.
#pragma once

#include <variant>
#include <vector>

#include <Eigen/Core>

#include "warp/space/lobe_table.hpp"

namespace remapc {

// The weight of differences between two reflectances over directions (An et al. 2011, equation 1). kRelative
// divides a difference by the mean reflectance of both materials plus 0.03. Its rank correlation with
// differences of lit spheres is 0.95; that of kPlain is 0.58, because highlight peaks dominate. Both are
// quadratic in reflectance. kCubeRoot and kLog compare the cube root and log(1 + rho / 0.05); their
// correlation is 0.96, but they have no closed form.
enum class AppearanceDistance { kRelative, kPlain, kCubeRoot, kLog };

inline constexpr Eigen::Index kFeatureBasis = 14;  // features per channel; the error is 3e-4 of the distance

// Features of parameters for a quadratic distance. The features of one channel are d * diffuse + s *
// slope(alpha) + base(alpha), where d is diffuse and s specular. Columns are nodes of alpha.
struct SeparableFeatures {
  Eigen::VectorXd diffuse;      // kFeatureBasis
  Eigen::MatrixXd slope, base;  // kFeatureBasis x kWidthNodes
};

// Features of samples for any distance. Samples are at the directions of half_vector_quadrature() or at the
// radii of profiles.
struct SampledFeatures {
  AppearanceDistance distance = AppearanceDistance::kRelative;
  std::vector<double> radii;  // union of both materials; empty for reflectances
  Eigen::VectorXd weights;    // square roots of the weights of the samples of one channel
  Eigen::MatrixXd basis;      // 3 x samples rows; orthonormal columns that span 512 texels
  LobeTable lobes;            // for parametric materials; empty for tables
  Eigen::VectorXd cosines;    // of the angle between light and half vector; dielectrics only
};

using AppearanceFeatures = std::variant<SeparableFeatures, SampledFeatures>;

// The features of both materials in one space.
struct FeaturePair {
  AppearanceFeatures source, target;
};

}  // namespace remapc
