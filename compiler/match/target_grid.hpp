// Pictures of a target on a coarse grid of widths and speculars. They give a search its starting points if
// the target has no family (ProbedModel::family).
#pragma once

#include <deque>
#include <mutex>
#include <vector>

#include "probe/picture_taker.hpp"

namespace remapc {

class TargetGrid {
 public:
  // Samples widths in `alphas`, evenly in log(alpha), and canonical speculars, evenly; without diffuse.
  TargetGrid(const PictureTaker& picture_taker, const ProbedModel& target, const remap::Range& alphas);

  // Returns at most three grid points, best first, at which the weighted squared difference from `source` is
  // no larger than at their neighbours. The first call renders the pictures. Thread-safe.
  std::vector<RoleValues> minima(const std::vector<float>& source, const std::vector<float>& weights) const;

 private:
  struct Slot {
    std::once_flag once;
    std::vector<float> picture;
  };
  const std::vector<float>& picture(std::size_t point) const;

  const PictureTaker& picture_taker_;
  ProbedModel target_;
  std::vector<RoleValues> points_;  // grouped by width
  mutable std::deque<Slot> slots_;
};

}  // namespace remapc
