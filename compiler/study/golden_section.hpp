// This file holds a one-dimensional search for the smallest errors in studies.
#pragma once

#include <utility>

namespace remap {

// Searches [low, high] by golden sections for the minimum of `f`, which must have only one minimum there.
// Each of the `steps` steps evaluates `f` once and shortens the interval to 0.618 of its length. Returns the
// best point and its value.
template <typename Function>
std::pair<double, double> golden_section(double low, double high, int steps, const Function& f) {
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = f(a), at_b = f(b);
  for (int step = 0; step < steps; ++step) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - kGolden * (high - low), at_a = f(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + kGolden * (high - low), at_b = f(b);
    }
  }
  return at_a < at_b ? std::pair(a, at_a) : std::pair(b, at_b);
}

}  // namespace remap
