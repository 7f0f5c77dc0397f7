// The specular lobe of a model over directions and widths: what features of parameters are made of.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "warp/space/material.hpp"
#include "warp/space/quadrature.hpp"

namespace remapc {

inline constexpr std::size_t kWidthNodes = 64;  // even in log(alpha) between these
inline constexpr double kLeastWidth = 0.04, kLargestWidth = 1.0;

// Between which two nodes an alpha lies, and how far: `fraction` from 0 to 1.
struct WidthPosition {
  Eigen::Index node = 0;
  double fraction = 0.0;
};
WidthPosition width_position(double alpha) noexcept;

// Slope and base of a model (Lobe of brdf.hpp) at every direction (rows) and node of alpha (columns).
struct LobeTable {
  Eigen::MatrixXd slope, base;
};
LobeTable lobe_table(const BrdfModel& model, const std::vector<QuadratureDirection>& directions);

inline constexpr std::size_t kReferenceTexels = 400;

// The mean reflectance of a material over 400 texels and all channels, at every direction.
Eigen::VectorXd mean_reflectance(const WarpMaterial& material, const LobeTable& table);

}  // namespace remapc
