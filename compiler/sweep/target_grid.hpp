// Pictures of a target on a coarse grid of widths and speculars: where a search starts for a target without a
// family (Subject::family).
#pragma once

#include <deque>
#include <mutex>
#include <vector>

#include "sweep/photographer.hpp"

namespace remapc {

class TargetGrid {
 public:
  // Widths in `alphas`, evenly in log(alpha), by canonical speculars, evenly; without diffuse.
  TargetGrid(const Photographer& photographer, const Subject& target, const remap::Range& alphas);

  // At most three grid points, best first, where the weighted squared difference from `source` is no larger
  // than at their neighbours. Pictures are rendered on the first call. Safe from many threads.
  std::vector<Sitting> minima(const std::vector<float>& source, const std::vector<float>& weights) const;

 private:
  struct Slot {
    std::once_flag once;
    std::vector<float> picture;
  };
  const std::vector<float>& picture(std::size_t point) const;

  const Photographer& photographer_;
  Subject target_;
  std::vector<Sitting> points_;  // width by width
  mutable std::deque<Slot> slots_;
};

}  // namespace remapc
