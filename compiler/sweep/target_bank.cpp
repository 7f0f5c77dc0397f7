#include "sweep/target_bank.hpp"

#include <algorithm>
#include <cmath>

#include "sweep/match.hpp"

namespace remapc {

TargetBank::TargetBank(const Photographer& photographer, const ModelDescription& target,
                       const remap::Range& alphas, double ratio)
    : photographer_(photographer),
      target_(target),
      max_specular_(target.parameter(ParameterRole::kSpecular).range.max) {
  const double span = std::log(alphas.max / alphas.min);
  // Interpolation needs a full window of nodes however narrow the range is.
  const auto steps =
      std::max<std::size_t>(kInterpolationNodes, static_cast<std::size_t>(std::ceil(span / std::log(ratio))));
  log_step_ = span / static_cast<double>(steps);
  for (std::size_t i = 0; i <= steps; ++i)
    alphas_.push_back(alphas.min * std::exp(log_step_ * static_cast<double>(i)));
  alphas_.back() = alphas.max;
  slots_.resize(alphas_.size());
}

const BankEntry& TargetBank::entry(std::size_t node) const {
  Slot& slot = slots_[node];
  std::call_once(slot.once, [&] {
    slot.entry.base = photographer_.take(target_, {alphas_[node], 0.0, 0.0});
    slot.entry.slope = photographer_.take(target_, {alphas_[node], max_specular_, 0.0});
    const double scale = 1.0 / max_specular_;
    for (std::size_t i = 0; i < slot.entry.base.size(); ++i)
      slot.entry.slope[i] =
          static_cast<float>((static_cast<double>(slot.entry.slope[i]) - slot.entry.base[i]) * scale);
  });
  return slot.entry;
}

}  // namespace remapc
