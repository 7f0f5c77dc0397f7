// Appearance spaces: principal coordinates of each material (An et al. 2011, section 3). Distances are
// Euclidean in features, so multidimensional scaling is a principal component analysis, without landmarks,
// and coordinates are closed forms of the parameters.
#pragma once

#include <array>

#include <Eigen/Core>

#include "warp/compiled_warp.hpp"
#include "warp/space/features.hpp"

namespace remapc {

// Positions of points, a row each; as many columns as the space has dimensions.
using Points = Eigen::MatrixXd;

struct AppearanceSpace {
  Eigen::VectorXd mean;  // of the features
  Eigen::MatrixXd axes;  // features x 3, orthonormal, the widest first
  double radius =
      0.0;  // RMS distance of texels from the mean: the unit of coordinates, and the spread of results
  std::array<double, 3> stress{};  // of 1, 2 and 3 dimensions: RMS error of distances over RMS distance
};

// From at most 16384 texels, 4096 where features are made from samples. Throws kInput where all of them look
// alike (radius below 1e-3 of the mean's length): there is nothing to tell apart.
AppearanceSpace appearance_space(const MaterialRef& material, const AppearanceFeatures& features);

// Positions of features, a column each, by the features themselves.
Points projected(const AppearanceSpace& space, const Eigen::MatrixXd& columns, int dimension);

// The smallest number of dimensions, at most 3, whose stress is below 3 %.
int dimension_of(const AppearanceSpace& space);

remap::AppearanceCoordinates closed_form(const AppearanceSpace& space, const SeparableFeatures& features,
                                         int dimension);

// All texels; those that are not finite give NaN.
Points positions_of(const remap::AppearanceCoordinates& coordinates,
                    const std::vector<remap::WarpTexel>& texels);

// Where the texels of a material lie.
struct Placement {
  // Of parameters: closed form or fitted; of tables: the position of every entry.
  std::variant<remap::AppearanceCoordinates, Points> coordinates;
  // RMS distance of fitted coordinates from the projection of features, over at most 4096 texels; 0 where
  // they are no fit.
  double fit_error = 0.0;
};

Placement placement_of(const MaterialRef& material, const AppearanceFeatures& features,
                       const AppearanceSpace& space, int dimension);

// Of all texels, or of those listed; NaN where a texel takes no part.
Points positions_of(const Placement& placement, const MaterialRef& material);
Points positions_of(const Placement& placement, const MaterialRef& material,
                    const std::vector<std::uint32_t>& texels);

}  // namespace remapc
