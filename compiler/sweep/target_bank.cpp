#include "sweep/target_bank.hpp"

#include <algorithm>
#include <cmath>

#include "sweep/interpolation.hpp"

namespace remapc {
namespace {

// Nodes on one side only multiply the error of interpolation by about 40; steps a quarter as wide divide it
// by 4^11.
constexpr double kEdgeRefinement = 4.0;
// Of the last step, as a share of the others.
constexpr double kLeastStep = 0.3;

}  // namespace

TargetBank::TargetBank(const Photographer& photographer, const Subject& target, const remap::Range& alphas,
                       double ratio)
    : photographer_(photographer), target_(target), speculars_(target.linear_range()) {
  // From the top down: a window of narrow steps, then the full ones.
  log_step_ = std::log(ratio);
  const double bottom = std::log(alphas.min), top = std::log(alphas.max);
  std::vector<double> logs = {top};
  while (logs.back() > bottom || logs.size() < kInterpolationNodes) {
    const bool narrow = logs.size() <= kInterpolationNodes;
    logs.push_back(logs.back() - (narrow ? log_step_ / kEdgeRefinement : log_step_));
  }
  // None below the range, where the target may not answer; a last step that is too narrow goes to its
  // neighbour.
  if (logs.size() > kInterpolationNodes) {
    if (logs[logs.size() - 2] - bottom < kLeastStep * log_step_) logs.pop_back();
    logs.back() = bottom;
  }
  for (auto log = logs.rbegin(); log != logs.rend(); ++log) alphas_.push_back(std::exp(*log));
  alphas_.back() = alphas.max;
  if (logs.back() == bottom) alphas_.front() = alphas.min;
  for (std::size_t i = 0; i < alphas_.size(); ++i) slots_.emplace_back();
}

const BankEntry& TargetBank::entry(std::size_t node) const {
  Slot& slot = slots_[node];
  slot.begun = true;
  std::call_once(slot.once, [&] {
    AffinePictures pictures = take_affine(photographer_, target_, alphas_[node]);
    slot.entry = {std::move(pictures.base), std::move(pictures.slope)};
  });
  return slot.entry;
}

void TargetBank::prepare(std::span<const std::size_t> nodes) const {
  for (const std::size_t node : nodes)
    if (!slots_[node].begun.exchange(true)) entry(node);
}

}  // namespace remapc
