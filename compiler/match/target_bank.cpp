#include "match/target_bank.hpp"

#include <algorithm>
#include <cmath>

#include "match/interpolation.hpp"

namespace remapc {
namespace {

// At the upper end all nodes of an interpolation are on one side, which multiplies its error by about 40;
// steps a quarter as wide divide it by 4^11.
constexpr double kEdgeRefinement = 4.0;

constexpr double kNarrowing = 4.0;

// Descends from the largest alpha: first a window of narrow steps, then full ones, to the first width at or
// below the smallest alpha. It ends at that alpha itself if the next step would fall below `least`, the
// model's limit.
std::vector<double> bank_alphas(const remap::Range& alphas, double ratio, double least) {
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
    // A node too close to its neighbour would multiply the noise of pictures.
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

remap::Range searched_widths(const ModelDescription& target, double narrowest) {
  return {std::max(target.alpha.min, narrowest / kNarrowing), target.alpha.max};
}

TargetBank::TargetBank(const PictureTaker& picture_taker, const ProbedModel& target,
                       const remap::Range& alphas, double ratio)
    : picture_taker_(picture_taker),
      target_(target),
      family_(target.family().value()),
      log_step_(std::log(ratio)),
      alphas_(bank_alphas(alphas, ratio, target.model.alpha.min)) {
  for (std::size_t i = 0; i < alphas_.size(); ++i) slots_.emplace_back();
}

const std::vector<std::vector<float>>& TargetBank::pictures(std::size_t node) const {
  Slot& slot = slots_[node];
  slot.begun = true;
  std::call_once(slot.once, [&] { slot.pictures = take_family(picture_taker_, target_, alphas_[node]); });
  return slot.pictures;
}

void TargetBank::prepare(std::span<const std::size_t> nodes) const {
  for (const std::size_t node : nodes)
    if (!slots_[node].begun.exchange(true)) pictures(node);
}

}  // namespace remapc
