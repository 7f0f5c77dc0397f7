// The forms of appearance features: in closed form, or by samples.
#pragma once

#include <variant>
#include <vector>

#include <Eigen/Core>

#include "warp/space/lobe_table.hpp"

namespace remapc {

// How the difference of two reflectances counts over directions (An et al. 2011, equation 1). kRelative
// divides it by the mean reflectance of both materials plus .03: rank correlation with differences of lit
// spheres .95 where the plain one has .58, which highlight peaks swamp. Both stay quadratic in reflectance.
// kCubeRoot and kLog compare its cube root and log(1 + rho / .05): .96, without a closed form.
enum class AppearanceDistance { kRelative, kPlain, kCubeRoot, kLog };

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

}  // namespace remapc
