// Pictures of a target on a coarse grid of widths and speculars: where a search starts for a target without a
// family (ProbedModel::family).
#pragma once

#include <deque>
#include <mutex>
#include <vector>

#include "probe/picture_taker.hpp"

namespace remapc {

class TargetGrid {
 public:
  // Widths in `alphas`, evenly in log(alpha), by canonical speculars, evenly; without diffuse.
  TargetGrid(const PictureTaker& picture_taker, const ProbedModel& target, const remap::Range& alphas);

  // At most three grid points, best first, where the weighted squared difference from `source` is no larger
  // than at their neighbours. Pictures are rendered on the first call. Safe from many threads.
  std::vector<RoleValues> minima(const std::vector<float>& source, const std::vector<float>& weights) const;

 private:
  struct Slot {
    std::once_flag once;
    std::vector<float> picture;
  };
  const std::vector<float>& picture(std::size_t point) const;

  const PictureTaker& picture_taker_;
  ProbedModel target_;
  std::vector<RoleValues> points_;  // width by width
  mutable std::deque<Slot> slots_;
};

}  // namespace remapc
