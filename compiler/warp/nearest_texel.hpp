// The nearest texel of the template to a position: results are reflectances that the template has (An et al.
// 2011, principle 5).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "warp/space/coordinates.hpp"

namespace remapc {

class NearestTexel {
 public:
  // Rows that are NaN are no texels; at least one must not be.
  explicit NearestTexel(const Points& positions);
  ~NearestTexel();
  NearestTexel(NearestTexel&&) noexcept;
  NearestTexel& operator=(NearestTexel&&) noexcept;

  // The row of `positions` that is nearest to each point.
  std::vector<std::uint32_t> find(const Points& points) const;

 private:
  struct Tree;
  template <std::size_t kDimension>
  struct TreeOf;
  std::unique_ptr<Tree> tree_;
};

}  // namespace remapc
