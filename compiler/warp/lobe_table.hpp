// This file holds the specular lobe of a model over directions and alpha, from which features of parameters
// are computed.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "warp/material.hpp"
#include "warp/quadrature.hpp"

namespace remap {

inline constexpr std::size_t kWidthNodes = 64;  // uniform in log(alpha) between kLeastWidth and kLargestWidth
inline constexpr double kLeastWidth = 0.04, kLargestWidth = 1.0;

// A WidthPosition is the position of an alpha between `node` and the next node; `fraction` is 0 to 1.
struct WidthPosition {
  Eigen::Index node = 0;
  double fraction = 0.0;
};
WidthPosition width_position(double alpha) noexcept;

// A LobeTable holds slope and base of a model (Lobe in brdf.hpp) at every direction (row) and node of alpha
// (column).
struct LobeTable {
  Eigen::MatrixXd slope, base;
};
LobeTable lobe_table(const BrdfModel& model, const std::vector<QuadratureDirection>& directions);

inline constexpr std::size_t kReferenceTexels = 400;

// Returns the mean reflectance of a material over kReferenceTexels texels and all channels, at every
// direction.
Eigen::VectorXd mean_reflectance(const WarpMaterial& material, const LobeTable& table);

}  // namespace remap
