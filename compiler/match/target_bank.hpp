// The bank of target pictures: for widths on a geometric grid, the few pictures that all others of that width
// are combinations of (specular_family.hpp), rendered once, when a search first asks for them.
#pragma once

#include <atomic>
#include <deque>
#include <mutex>
#include <span>
#include <vector>

#include "probe/picture_taker.hpp"

namespace remapc {

// Neighbouring widths of a bank, at most. Interpolating the loss over twelve of them is good to 1e-7 in
// alpha.
inline constexpr double kBankRatio = 1.05;

// Widths of `target` that a search looks at for sources whose narrowest width is `narrowest`: from a quarter
// of that, since no pair of the hub differs by more than 2.
remap::Range searched_widths(const ModelDescription& target, double narrowest);

class TargetBank {
 public:
  // A bank for widths in `alphas` and no less than the model takes: neighbours at most `ratio` apart (the
  // last two half as much again), closer at the upper end, where interpolation has nodes on one side only.
  // `target` must have a family (ProbedModel::family).
  TargetBank(const PictureTaker& picture_taker, const ProbedModel& target, const remap::Range& alphas,
             double ratio);

  std::size_t size() const { return alphas_.size(); }
  double alpha(std::size_t node) const { return alphas_[node]; }
  double log_step() const { return log_step_; }  // largest, in log(alpha)
  const SpecularFamily& family() const { return family_; }

  // The pictures of a node (take_family); rendered on the first call, kept for the next. Safe from many
  // threads.
  const std::vector<std::vector<float>>& pictures(std::size_t node) const;

  // Renders those of `nodes` that no other thread has begun: threads that want the same nodes share the work
  // instead of waiting for each other at every one.
  void prepare(std::span<const std::size_t> nodes) const;

 private:
  struct Slot {
    std::once_flag once;
    std::atomic<bool> begun{false};
    std::vector<std::vector<float>> pictures;
  };
  const PictureTaker& picture_taker_;
  ProbedModel target_;
  SpecularFamily family_;
  double log_step_;
  std::vector<double> alphas_;
  mutable std::deque<Slot> slots_;
};

}  // namespace remapc
