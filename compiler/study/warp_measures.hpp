// How good a result is where the right one is known: measures of warps over all texels. Distances are those
// of appearance (features.hpp), in percent of the template's spread, the RMS distance of its texels from
// their mean; two unrelated texels of the template are 141 % apart (RMS).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "study/warp_case.hpp"
#include "warp/warp.hpp"

namespace remapc {

// For each texel of the source the texel of the template that it gets.
using TexelCopy = std::vector<std::uint32_t>;

struct WarpFigures {
  double mean = 0.0, rms = 0.0, median = 0.0, p95 = 0.0;  // distance to the truth over all texels, %
  double strokes = 0.0;  // of texels on source strokes, mean distance to the nearest texel of the template's
                         // stroke, %
  double used = 0.0;     // template's occupied bins (four texels or more) that the result has, %
  double tears = 0.0;    // neighbours in the source's appearance space, at most .05 of its spread apart,
                         // that land more than 25 % apart, %
  double variation = 0.0;  // mean distance between texels side by side, over that of the truth
};

// Of what a fit compiles to.
struct CompiledFigures {
  double mean = 0.0;        // distance to the truth, %
  double difference = 0.0;  // mean distance to the exact copy, %
};

// What measures of one case have in common. Rows and columns: Eigen's.
class WarpMeasures {
 public:
  explicit WarpMeasures(const WarpCase& measured);

  WarpFigures of_copy(const TexelCopy& copy, const std::vector<StrokePair>& strokes) const;
  CompiledFigures of_compiled(const remap::CompiledWarp& compiled, const TexelCopy& exact) const;
  // Mean distance between two results, %.
  double change(const TexelCopy& a, const TexelCopy& b) const;
  // Distance of each texel to the truth, %.
  std::vector<double> distances(const TexelCopy& copy) const;

  // The nearest texel of the template to each of the source without any warp, and to the truth: what no copy
  // can be better than.
  TexelCopy nearest() const;
  TexelCopy of_truth() const;

 private:
  double stroke_distance(const TexelCopy& copy, const std::vector<StrokePair>& strokes) const;
  double used_bins(const TexelCopy& copy) const;
  double variation(const Eigen::MatrixXd& features) const;
  Eigen::MatrixXd features_of_copy(const TexelCopy& copy) const;
  Points on_target_axes(const Eigen::MatrixXd& features) const;

  const WarpCase& case_;
  FeaturePair pair_;
  AppearanceSpace target_space_;
  Eigen::MatrixXd source_, target_, truth_;  // features, a column a texel
  std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_;
  std::vector<long> bins_;  // of the template's texels; -1: none that counts
  double bin_count_ = 0.0;
  double truth_variation_ = 1.0;
};

}  // namespace remapc
