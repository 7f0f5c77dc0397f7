// This file has std::ranges::contains of C++23.
#pragma once

#include <algorithm>
#include <iterator>

namespace remap {

// Returns true if an item of the range, or the projection of an item, equals the value.
template <typename Range, typename Value, typename... Projection>
constexpr bool contains(const Range& range, const Value& value, Projection... projection) {
  return std::ranges::find(range, value, projection...) != std::end(range);
}

}  // namespace remap
