// This file sums over the pixels of pictures in double precision. It adds to a fixed number of sums in a
// fixed order, so the result does not depend on how the compiler vectorises the loop.
#pragma once

#include <array>
#include <cstddef>

namespace remap {

inline constexpr std::size_t kLanes = 4;
using LaneSums = std::array<double, kLanes>;

inline double total(const LaneSums& sums) { return (sums[0] + sums[1]) + (sums[2] + sums[3]); }

// Calls `add(pixel, lane)` for every pixel; pixel i is in lane i modulo kLanes.
template <typename Add>
void for_each_pixel(std::size_t count, const Add& add) {
  const std::size_t whole = count - count % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) add(i + lane, lane);
  for (std::size_t i = whole; i < count; ++i) add(i, i - whole);
}

inline double inner_product(const float* a, const float* b, std::size_t count) {
  LaneSums sums{};
  for_each_pixel(count, [&](std::size_t i, std::size_t lane) {
    sums[lane] += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  });
  return total(sums);
}

// Returns the sum of weights * a * b.
inline double weighted_product(const float* weights, const float* a, const float* b, std::size_t count) {
  LaneSums sums{};
  for_each_pixel(count, [&](std::size_t i, std::size_t lane) {
    sums[lane] += static_cast<double>(weights[i]) * static_cast<double>(a[i]) * static_cast<double>(b[i]);
  });
  return total(sums);
}

}  // namespace remap
