#include "study/warp_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace remapc {
namespace {

constexpr double kShift = 0.02,
                 kMostApart = 0.05;  // distances of neighbors, relative to the spread of the source
constexpr int kAxes = 3;             // along which neighbors are found
constexpr double kTorn = 0.25;       // relative to the spread of the template
constexpr int kLeastTexels = 4;      // of an occupied bin

Eigen::MatrixXd columns_of(const AppearanceFeatures& features, const std::vector<remap::WarpTexel>& texels) {
  Eigen::MatrixXd columns(3 * kFeatureBasis, static_cast<Eigen::Index>(texels.size()));
  for (std::size_t i = 0; i < texels.size(); ++i)
    columns.col(static_cast<Eigen::Index>(i)) = features_of(features, texels[i]);
  return columns;
}

// Finds for each texel a neighbor along one axis; the axis alternates from texel to texel. Texels at the edge
// of the distribution have no neighbor.
std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_of(const Points& positions) {
  Points beside = positions;
  for (Eigen::Index i = 0; i < positions.rows(); ++i) beside(i, i % positions.cols()) += kShift;
  const std::vector<std::uint32_t> found = NearestTexel(positions).find(beside);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours;
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    const double apart = (positions.row(i) - positions.row(found[i])).norm();
    if (found[i] != i && apart < kMostApart) neighbours.emplace_back(i, found[i]);
  }
  return neighbours;
}

// The value below which a share of `share` of the values lies.
double quantile(std::vector<double> values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

}  // namespace

WarpMeasures::WarpMeasures(const WarpCase& measured)
    : case_(measured),
      pair_(appearance_features(measured.source, measured.target)),
      target_space_(appearance_space(measured.target, pair_.target)),
      source_(columns_of(pair_.source, measured.source.texels)),
      target_(columns_of(pair_.target, measured.target.texels)),
      truth_(columns_of(pair_.target, measured.truth)) {
  neighbours_ = neighbours_of(projected(appearance_space(measured.source, pair_.source), source_, kAxes));
  const Points positions = on_target_axes(target_).leftCols(dimension_of(target_space_));
  const BinGrid grid(positions, occupancy_of(positions, {}).spacing);
  std::vector<int> counts(grid.size(), 0);
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    bins_.push_back(grid.bin_of(positions, i));
    if (bins_.back() >= 0) ++counts[static_cast<std::size_t>(bins_.back())];
  }
  for (long& bin : bins_)
    if (bin >= 0 && counts[static_cast<std::size_t>(bin)] < kLeastTexels) bin = -1;
  bin_count_ = static_cast<double>(
      std::count_if(counts.begin(), counts.end(), [](int count) { return count >= kLeastTexels; }));
  truth_variation_ = variation(truth_);
}

Points WarpMeasures::on_target_axes(const Eigen::MatrixXd& features) const {
  return projected(target_space_, features, kAxes);
}

TexelCopy WarpMeasures::nearest() const {
  return NearestTexel(on_target_axes(target_)).find(on_target_axes(source_));
}

TexelCopy WarpMeasures::of_truth() const {
  return NearestTexel(on_target_axes(target_)).find(on_target_axes(truth_));
}

Eigen::MatrixXd WarpMeasures::features_of_copy(const TexelCopy& copy) const {
  Eigen::MatrixXd features(target_.rows(), static_cast<Eigen::Index>(copy.size()));
  for (std::size_t i = 0; i < copy.size(); ++i)
    features.col(static_cast<Eigen::Index>(i)) = target_.col(copy[i]);
  return features;
}

std::vector<double> WarpMeasures::distances(const TexelCopy& copy) const {
  const double scale = 100.0 / target_space_.radius;
  std::vector<double> distances;
  distances.reserve(copy.size());
  for (std::size_t i = 0; i < copy.size(); ++i)
    distances.push_back(scale * (target_.col(copy[i]) - truth_.col(static_cast<Eigen::Index>(i))).norm());
  return distances;
}

double WarpMeasures::change(const TexelCopy& a, const TexelCopy& b) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (target_.col(a[i]) - target_.col(b[i])).norm();
  return 100.0 * sum / target_space_.radius / static_cast<double>(a.size());
}

double WarpMeasures::stroke_distance(const TexelCopy& copy, const std::vector<StrokePair>& strokes) const {
  double sum = 0.0, count = 0.0;
  for (const StrokePair& stroke : strokes)
    for (const std::uint32_t texel : stroke.source) {
      double least = std::numeric_limits<double>::infinity();
      for (const std::uint32_t other : stroke.target)
        least = std::min(least, (target_.col(copy[texel]) - target_.col(other)).squaredNorm());
      sum += std::sqrt(least);
      count += 1.0;
    }
  return 100.0 * sum / count / target_space_.radius;
}

double WarpMeasures::used_bins(const TexelCopy& copy) const {
  std::set<long> used;
  for (const std::uint32_t texel : copy) used.insert(bins_[texel]);
  used.erase(-1);
  return 100.0 * static_cast<double>(used.size()) / bin_count_;
}

double WarpMeasures::variation(const Eigen::MatrixXd& features) const {
  double sum = 0.0;
  for (std::size_t y = 0; y < case_.height; ++y)
    for (std::size_t x = 1; x < case_.width; ++x) {
      const auto texel = static_cast<Eigen::Index>(y * case_.width + x);
      sum += (features.col(texel) - features.col(texel - 1)).norm();
    }
  return sum / truth_variation_;
}

WarpFigures WarpMeasures::of_copy(const TexelCopy& copy, const std::vector<StrokePair>& strokes) const {
  WarpFigures figures;
  const std::vector<double> errors = distances(copy);
  for (const double error : errors) {
    figures.mean += error / static_cast<double>(errors.size());
    figures.rms += error * error / static_cast<double>(errors.size());
  }
  figures.rms = std::sqrt(figures.rms);
  figures.median = quantile(errors, 0.5);
  figures.p95 = quantile(errors, 0.95);
  figures.strokes = stroke_distance(copy, strokes);
  figures.used = used_bins(copy);
  double torn = 0.0;
  for (const auto& [texel, other] : neighbours_) {
    const double apart = (target_.col(copy[texel]) - target_.col(copy[other])).norm();
    torn += apart > kTorn * target_space_.radius ? 1.0 : 0.0;
  }
  figures.tears = 100.0 * torn / static_cast<double>(std::max<std::size_t>(neighbours_.size(), 1));
  figures.variation = variation(features_of_copy(copy));
  return figures;
}

CompiledFigures WarpMeasures::of_compiled(const remap::CompiledWarp& compiled, const TexelCopy& exact) const {
  CompiledFigures figures;
  const double scale = 100.0 / target_space_.radius / static_cast<double>(exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Eigen::VectorXd own =
        features_of(pair_.target, remap::evaluate_warp(compiled, case_.source.texels[i]));
    figures.mean += scale * (own - truth_.col(static_cast<Eigen::Index>(i))).norm();
    figures.difference += scale * (own - target_.col(exact[i])).norm();
  }
  return figures;
}

}  // namespace remapc
