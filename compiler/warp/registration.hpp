// This file computes the warp, a map from the source's appearance space to the template's, from strokes and
// points. A few hundred points (occupancy) represent all texels of a material. A rare appearance then has the
// same weight as a frequent one (An et al. 2011, section 3.2). Strokes give an affine map. From there, both
// sets of points are registered by annealing, with a bending prior.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "warp/coordinates.hpp"

namespace remap {

// Returns the least and the largest coordinate along an axis, ignoring NaN.
Range extent_of(const Points& positions, Eigen::Index axis);

// Returns the mean position of the finite `texels`, or the origin if no texel is finite.
Eigen::RowVectorXd centre_of(const Points& positions, const std::vector<std::uint32_t>& texels);

struct Occupancy {
  Points points;                          // centroids of the bins with four texels or more
  Eigen::VectorXd texel_count;            // number of texels of each point
  std::vector<std::vector<int>> strokes;  // for each stroke, at least one point with texels of the stroke
  double spacing = 0.0;                   // width of a bin
};

// Searches the width of the bins so that about 350 bins contain at least four texels. Any number from 300 to
// 1200 points gives results within one percentage point of error. `positions` belong to texels; NaN is
// ignored. `strokes` are indices of texels. If all texels of a stroke are in sparse bins, the stroke gets the
// point closest to its centre.
Occupancy occupancy_of(const Points& positions, const std::vector<std::vector<std::uint32_t>>& strokes);

// A BinGrid is the grid of `occupancy_of`. It finds the bin of a position.
class BinGrid {
 public:
  BinGrid(const Points& positions, double spacing);
  std::size_t size() const noexcept { return size_; }
  // Returns the index of the bin, or -1 for NaN.
  long bin_of(const Points& positions, Eigen::Index i) const noexcept;

 private:
  Eigen::Index dimension_ = 0;
  double spacing_ = 1.0;
  std::array<double, 3> low_{};
  std::array<long, 3> cells_{1, 1, 1};
  std::size_t size_ = 1;
};

// An AffineMap is F(x) = x linear + offset, where rows are points.
struct AffineMap {
  Eigen::MatrixXd linear;     // dimension x dimension
  Eigen::RowVectorXd offset;  // dimension values
};

// A SmoothWarp is F(x) = x linear + offset + sum_c weights_c exp(-|x - centre_c|^2 / (2 width^2)).
struct SmoothWarp {
  AffineMap affine;
  Points centres;
  Eigen::MatrixXd weights;  // centres x dimension
  double width = 1.0;
};

// Return the images of points, one row per point. NaN gives NaN.
Points images_of(const AffineMap& map, const Points& points);
Points images_of(const SmoothWarp& warp, const Points& points);

// Returns the factors exp(...) of a SmoothWarp: points x centres.
Eigen::MatrixXd gaussians(const Points& points, const Points& centres, double width);

// Returns the fraction of `weights` at points where the warp folds. There, its orientation differs from the
// orientation at most points. The orientation is the sign of the determinant of the Jacobian, which central
// differences give.
double fold_share(const SmoothWarp& warp, const Points& points, const Eigen::VectorXd& weights);

// A PointSets holds both materials as points. `common_axes` maps each source axis to the direction of the
// same change of reflectance in the template. It is the rotation (or reflection) closest to V_S^T V_T.
struct PointSets {
  Occupancy source, target;
  Eigen::MatrixXd common_axes;  // dimension x dimension
  Points source_centres;        // centres of the texels of each stroke
  Points target_centres;
};

Eigen::MatrixXd common_axes(const AppearanceSpace& source, const AppearanceSpace& target, int dimension);

// Returns the mean position of the finite texels of each stroke, one row per stroke.
Points stroke_centres(const Points& positions, const std::vector<std::vector<std::uint32_t>>& strokes);

// Fits the centres of strokes by least squares, with the prior |linear - common axes|^2. The prior determines
// directions that the strokes leave open. Its weight is high (0.3), so that a registration starts close to
// the common axes.
AffineMap affine_from_strokes(const PointSets& sets);

// Computes a SmoothWarp with 80 centres of width 1.2 in 25 steps with sigma from 0.4 to 0.05. Each step
// matches all points softly, and separately the points of every stroke pair with 1.5 times the weight. Then
// it solves one linear least squares problem with the bending prior 10 sigma^2 / 0.05 w' K w / 80. The
// optimum is flat: half or twice any of these numbers changes the error by about one percentage point. The
// result is deterministic.
SmoothWarp register_points(const PointSets& sets, const AffineMap& start);

}  // namespace remap
