#include "match/target_grid.hpp"

#include <algorithm>
#include <cmath>

#include "probe/picture_sums.hpp"

namespace remapc {
namespace {

constexpr std::size_t kWidths = 14;
constexpr std::size_t kSpeculars = 8;
constexpr std::size_t kMostMinima = 3;

}  // namespace

TargetGrid::TargetGrid(const PictureTaker& picture_taker, const ProbedModel& target,
                       const remap::Range& alphas)
    : picture_taker_(picture_taker), target_(target), slots_(kWidths * kSpeculars) {
  const remap::Range speculars = target.linear_range();
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
  Slot& slot = slots_[point];
  std::call_once(slot.once, [&] { slot.picture = picture_taker_.take(target_, points_[point]); });
  return slot.picture;
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

}  // namespace remapc
