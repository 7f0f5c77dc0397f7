// This file finds the texel of the template that is closest to a position. So all results are reflectances of
// the template (An et al. 2011, principle 5).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "warp/coordinates.hpp"

namespace remap {

class NearestTexel {
 public:
  // Ignores rows with NaN; at least one row must be finite.
  explicit NearestTexel(const Points& positions);

  // Returns the index of the closest row of `positions` for each point.
  std::vector<std::uint32_t> find(const Points& points) const { return find_(points); }

 private:
  std::function<std::vector<std::uint32_t>(const Points&)> find_;
};

}  // namespace remap
