// Measures the error of a warp whose correct result is known, over all texels. Distances are appearance
// distances (features.hpp) in percent of the template's spread, which is the RMS distance of its texels from
// their mean. Two unrelated texels of the template are 141 % apart (RMS).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "study/warp_case.hpp"
#include "warp/warp.hpp"

namespace remapc {

// The template texel that each source texel is replaced by.
using TexelCopy = std::vector<std::uint32_t>;

struct WarpFigures {
  double mean = 0.0, rms = 0.0, median = 0.0, p95 = 0.0;  // distance to the truth, %
  double strokes = 0.0;  // mean distance of results on source strokes to the template's stroke, %
  double used = 0.0;     // share of the template's occupied bins (four texels or more) in the result, %
  double tears = 0.0;    // share of neighbors in the source's appearance space, at most 0.05 of its
  // spread apart, whose results are more than 25 % apart, %
  double variation = 0.0;  // mean distance between adjacent texels, relative to the truth
};

// The error of the compiled converter.
struct CompiledFigures {
  double mean = 0.0;        // distance to the truth, %
  double difference = 0.0;  // mean distance to the exact copy, %
};

// Measures the results for one case, which must outlive it.
class WarpMeasures {
 public:
  explicit WarpMeasures(const WarpCase& measured);

  WarpFigures of_copy(const TexelCopy& copy, const std::vector<StrokePair>& strokes) const;
  CompiledFigures of_compiled(const remap::CompiledWarp& compiled, const TexelCopy& exact) const;
  // Mean distance between two results, %.
  double change(const TexelCopy& a, const TexelCopy& b) const;
  // Distance of each texel to the truth, %.
  std::vector<double> distances(const TexelCopy& copy) const;

  // The template texel nearest to each source texel without a warp, and nearest to the truth. No copy is more
  // accurate than the latter.
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
  Eigen::MatrixXd source_, target_, truth_;  // features, one column per texel
  std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_;
  std::vector<long> bins_;  // of the template's texels; -1: bin with too few texels
  double bin_count_ = 0.0;
  double truth_variation_ = 1.0;
};

}  // namespace remapc
