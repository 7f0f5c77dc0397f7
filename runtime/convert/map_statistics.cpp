#include <algorithm>
#include <cmath>
#include <limits>

#include "remap/convert_maps.hpp"

namespace remap {
namespace {

constexpr double kResidualUnit = 0x1p-40;

template <typename Map>
void add_all(Map& sums, const Map& more) {
  for (const auto& [parameter, statistics] : more) sums[parameter] += statistics;
}

}  // namespace

ParameterStatistics statistics_of(std::span<const float> values) {
  ParameterStatistics statistics;
  statistics.min = std::numeric_limits<float>::max();
  statistics.max = -statistics.min;
  for (const float value : values) {
    const bool counts = std::fabs(value) <= std::numeric_limits<float>::max();
    statistics.min = counts && value < statistics.min ? value : statistics.min;
    statistics.max = counts && value > statistics.max ? value : statistics.max;
    statistics.finite_count += counts;
  }
  constexpr float kBins = static_cast<float>(ParameterStatistics::kBins);
  for (const float value : values) {
    if (std::isnan(value)) continue;
    const float bin = std::clamp(value * kBins, 0.0f, kBins - 1.0f);
    ++statistics.histogram[static_cast<std::size_t>(bin)];
  }
  return statistics;
}

MetallicStatistics statistics_of(TexelPosition first, std::span<const float> residual, const float* issues,
                                 const float* coverage) {
  MetallicStatistics sum;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    if (std::isnan(residual[i]) || (coverage != nullptr && !(coverage[i] > 0.0f))) continue;
    const long found = std::lround(issues[i] * 255.0f);
    const auto count_if_has = [&](MetallicIssue issue, IssueStatistics& texels) {
      if ((found & static_cast<long>(issue)) != 0) texels += {1, TexelPosition{first.x + i, first.y}};
    };
    const double square = static_cast<double>(residual[i]) * static_cast<double>(residual[i]);
    ++sum.texel_count;
    sum.residual_squares += static_cast<std::uint64_t>(std::llround(square / kResidualUnit));
    sum.largest_residual = std::max(sum.largest_residual, residual[i]);
    count_if_has(MetallicIssue::kUndetermined, sum.undetermined);
    count_if_has(MetallicIssue::kDark, sum.dark);
    count_if_has(MetallicIssue::kAmbiguous, sum.ambiguous);
    count_if_has(MetallicIssue::kClamped, sum.clamped);
  }
  return sum;
}

double MetallicStatistics::rms_residual() const noexcept {
  if (texel_count == 0) return 0.0;
  return std::sqrt(static_cast<double>(residual_squares) * kResidualUnit / static_cast<double>(texel_count));
}

IssueStatistics& IssueStatistics::operator+=(const IssueStatistics& other) noexcept {
  count += other.count;
  if (!first) first = other.first;
  return *this;
}

MetallicStatistics& MetallicStatistics::operator+=(const MetallicStatistics& other) noexcept {
  texel_count += other.texel_count;
  residual_squares += other.residual_squares;
  largest_residual = std::max(largest_residual, other.largest_residual);
  undetermined += other.undetermined;
  dark += other.dark;
  ambiguous += other.ambiguous;
  clamped += other.clamped;
  return *this;
}

ParameterStatistics& ParameterStatistics::operator+=(const ParameterStatistics& other) noexcept {
  if (other.finite_count > 0) {
    min = finite_count > 0 ? std::min(min, other.min) : other.min;
    max = finite_count > 0 ? std::max(max, other.max) : other.max;
  }
  finite_count += other.finite_count;
  for (std::size_t i = 0; i < kBins; ++i) histogram[i] += other.histogram[i];
  return *this;
}

MapStatistics& MapStatistics::operator+=(const MapStatistics& other) {
  texel_count += other.texel_count;
  out_of_domain_count += other.out_of_domain_count;
  nan_count += other.nan_count;
  infinite_count += other.infinite_count;
  negative_count += other.negative_count;
  clipped_count += other.clipped_count;
  masked_count += other.masked_count;
  above_one_count += other.above_one_count;
  if (!first_bad) first_bad = other.first_bad;
  add_all(sources, other.sources);
  add_all(targets, other.targets);
  for (const auto& [parameter, tint] : other.tints) tints[parameter] = std::max(tints[parameter], tint);
  metallic += other.metallic;
  return *this;
}

}  // namespace remap
