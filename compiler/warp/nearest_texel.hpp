// Finds the template texel nearest to a position. All results are reflectances of the template (An et al.
// 2011, principle 5).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "warp/space/coordinates.hpp"

namespace remapc {

class NearestTexel {
 public:
  // Rows with NaN are ignored; at least one row must be finite.
  explicit NearestTexel(const Points& positions);
  ~NearestTexel();
  NearestTexel(NearestTexel&&) noexcept;
  NearestTexel& operator=(NearestTexel&&) noexcept;

  // Returns the index of the nearest row of `positions` for each point.
  std::vector<std::uint32_t> find(const Points& points) const;

 private:
  struct Tree;
  template <std::size_t kDimension>
  struct TreeOf;
  std::unique_ptr<Tree> tree_;
};

}  // namespace remapc
