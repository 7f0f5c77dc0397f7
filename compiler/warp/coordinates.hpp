// This file computes appearance spaces, which are principal coordinates of each material (An et al. 2011,
// section 3). Distances are Euclidean in features. So multidimensional scaling is a principal component
// analysis that needs no landmarks, and coordinates are closed formulas of the parameters.
#pragma once

#include <array>

#include <Eigen/Core>

#include "remap/warp.hpp"
#include "warp/features.hpp"

namespace remap {

// Points holds positions: one row per point, one column per dimension.
using Points = Eigen::MatrixXd;

struct AppearanceSpace {
  Eigen::VectorXd mean;            // mean of the features
  Eigen::MatrixXd axes;            // features x 3, orthonormal, in order of decreasing variance
  double radius = 0.0;             // RMS distance of texels from the mean, the unit of coordinates
  std::array<double, 3> stress{};  // RMS error of distances over RMS distance, in 1, 2 and 3 dimensions
};

// Computes the space from at most 16384 texels, or 4096 for features by samples. Throws kInput if all texels
// look the same (radius below 1e-3 of the length of the mean).
AppearanceSpace appearance_space(const MaterialRef& material, const AppearanceFeatures& features);

// Projects features, one column per texel, to positions.
Points projected(const AppearanceSpace& space, const Eigen::MatrixXd& columns, int dimension);

// Returns the smallest number of dimensions, at most 3, whose stress is below 3 %.
int dimension_of(const AppearanceSpace& space);

AppearanceCoordinates closed_form(const AppearanceSpace& space, const SeparableFeatures& features,
                                  int dimension);

// Returns positions of all texels. Texels that are not finite get NaN.
Points positions_of(const AppearanceCoordinates& coordinates, const std::vector<WarpTexel>& texels);

// A Placement holds the coordinates of a material's texels.
struct Placement {
  // For parameters, this is a formula, exact or fitted. For tables, it has the position of every entry.
  std::variant<AppearanceCoordinates, Points> coordinates;
  // This is the RMS distance of fitted coordinates from the projected features, over at most 4096 texels. It
  // is 0 for a closed form and for tables.
  double fit_error = 0.0;
};

Placement placement_of(const MaterialRef& material, const AppearanceFeatures& features,
                       const AppearanceSpace& space, int dimension);

// Return positions of all texels, or of `texels`. Texels that are not finite or not in the table get NaN.
Points positions_of(const Placement& placement, const MaterialRef& material);
Points positions_of(const Placement& placement, const MaterialRef& material,
                    const std::vector<std::uint32_t>& texels);

}  // namespace remap
