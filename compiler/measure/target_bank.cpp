#include "measure/target_bank.hpp"

#include <algorithm>
#include <cmath>

#include "measure/picture_sums.hpp"

namespace remap {
namespace {

// Steps at the upper end are narrower by this factor. All nodes of an interpolation there are on one side,
// which multiplies its error by about 40. A quarter of the step divides the error by 4^11.
constexpr double kEdgeRefinement = 4.0;

constexpr double kNarrowing = 4.0;

// This is the size of the grid for a target without a family.
constexpr std::size_t kWidths = 14;
constexpr std::size_t kSpeculars = 8;
constexpr std::size_t kMostMinima = 3;

// Returns widths in falling order, from the largest alpha. The first steps, as many as an interpolation
// needs, are narrow. Full steps follow, to the first width at or below the smallest alpha. If this width
// would be below `least`, the model's limit, the last width is the smallest alpha itself.
std::vector<double> bank_alphas(const Range& alphas, double ratio, double least) {
  const double bottom = std::log(alphas.min), top = std::log(alphas.max), step = std::log(ratio);
  double narrow_step = step / kEdgeRefinement;
  if (least < alphas.max)
    narrow_step =
        std::min(narrow_step, (top - std::log(least)) / static_cast<double>(kInterpolationNodes - 1));
  std::vector<double> logs = {top};
  while (logs.back() > bottom || logs.size() < kInterpolationNodes)
    logs.push_back(logs.back() - (logs.size() <= kInterpolationNodes ? narrow_step : step));
  const bool below = std::exp(logs.back()) < least;
  if (below) {
    // If two nodes were too close, the noise of pictures would grow.
    const double before_last = logs[logs.size() - 2];
    if (logs.size() > kInterpolationNodes && before_last - bottom < 0.5 * (before_last - logs.back()))
      logs.pop_back();
  }
  std::vector<double> widths;
  for (auto log = logs.rbegin(); log != logs.rend(); ++log) widths.push_back(std::exp(*log));
  if (below) widths.front() = alphas.min;
  widths.back() = alphas.max;
  return widths;
}

}  // namespace

Range searched_widths(const ModelDescription& target, double narrowest) {
  return {std::max(target.alpha.min, narrowest / kNarrowing), target.alpha.max};
}

TargetBank::TargetBank(const PictureTaker& picture_taker, const ProbedModel& target, const Range& alphas,
                       double ratio)
    : picture_taker_(picture_taker),
      target_(target),
      family_(target.family().value()),
      log_step_(std::log(ratio)),
      alphas_(bank_alphas(alphas, ratio, target.model.alpha.min)),
      are_rendered_(alphas_.size()),
      are_begun_(alphas_.size()),
      pictures_(alphas_.size()) {}

const std::vector<std::vector<float>>& TargetBank::pictures(std::size_t node) const {
  are_begun_[node] = true;
  std::call_once(are_rendered_[node],
                 [&] { pictures_[node] = take_family(picture_taker_, target_, alphas_[node]); });
  return pictures_[node];
}

void TargetBank::prepare(std::span<const std::size_t> nodes) const {
  for (const std::size_t node : nodes)
    if (!are_begun_[node].exchange(true)) pictures(node);
}

TargetGrid::TargetGrid(const PictureTaker& picture_taker, const ProbedModel& target, const Range& alphas)
    : picture_taker_(picture_taker),
      target_(target),
      are_rendered_(kWidths * kSpeculars),
      pictures_(are_rendered_.size()) {
  const Range speculars = target.linear_range();
  for (std::size_t i = 0; i < kWidths; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kWidths - 1);
    const double alpha = alphas.min * std::pow(alphas.max / alphas.min, share);
    for (std::size_t j = 1; j <= kSpeculars; ++j)
      points_.push_back({std::min(alpha, alphas.max),
                         speculars.min + (speculars.max - speculars.min) * static_cast<double>(j) /
                                             static_cast<double>(kSpeculars),
                         0.0});
  }
}

const std::vector<float>& TargetGrid::picture(std::size_t point) const {
  std::call_once(are_rendered_[point],
                 [&] { pictures_[point] = picture_taker_.take(target_, points_[point]); });
  return pictures_[point];
}

std::vector<RoleValues> TargetGrid::minima(const std::vector<float>& source,
                                           const std::vector<float>& weights) const {
  std::vector<double> losses(points_.size());
  std::vector<float> difference(source.size());
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const std::vector<float>& target = picture(p);
    for (std::size_t i = 0; i < source.size(); ++i) difference[i] = target[i] - source[i];
    losses[p] = weighted_product(weights.data(), difference.data(), difference.data(), source.size());
  }
  const auto is_minimum = [&](std::size_t p) {
    const std::size_t i = p / kSpeculars, j = p % kSpeculars;
    for (std::size_t k = i - std::min<std::size_t>(i, 1); k <= std::min(i + 1, kWidths - 1); ++k)
      for (std::size_t l = j - std::min<std::size_t>(j, 1); l <= std::min(j + 1, kSpeculars - 1); ++l)
        if (losses[k * kSpeculars + l] < losses[p]) return false;
    return true;
  };
  std::vector<std::size_t> found;
  for (std::size_t p = 0; p < points_.size(); ++p)
    if (is_minimum(p)) found.push_back(p);
  std::sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) { return losses[a] < losses[b]; });
  std::vector<RoleValues> starts;
  for (std::size_t i = 0; i < std::min(found.size(), kMostMinima); ++i) starts.push_back(points_[found[i]]);
  return starts;
}

}  // namespace remap
