// This file tabulates the specular lobe of a model over directions and alpha. Features are computed from this
// table.
#pragma once

#include <vector>

#include <Eigen/Core>

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

}  // namespace remap
