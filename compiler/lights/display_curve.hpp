// This file holds the display transfer function as a table, for searches that evaluate it billions of times.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "look/image.hpp"

namespace remap {

// A DisplayCurve interpolates linearly in a table of 2^16 values. The error is below 1e-7.
class DisplayCurve {
 public:
  DisplayCurve() {
    for (std::size_t i = 0; i <= kCells; ++i)
      values_[i] = display_value(static_cast<double>(i) / static_cast<double>(kCells));
  }
  // Returns the display value and the slope of the curve.
  std::pair<float, float> operator()(float linear) const {
    if (linear <= 0.0f) return {0.0f, 0.0f};
    if (linear >= 1.0f) return {1.0f, 0.0f};
    const auto cell = static_cast<std::size_t>(linear * static_cast<float>(kCells));
    const float rest = linear * static_cast<float>(kCells) - static_cast<float>(cell);
    const float step = values_[cell + 1] - values_[cell];
    return {values_[cell] + rest * step, step * static_cast<float>(kCells)};
  }

 private:
  static constexpr std::size_t kCells = 65536;
  std::array<float, kCells + 1> values_{};
};

inline const DisplayCurve& display_curve() {
  static const DisplayCurve curve;
  return curve;
}

}  // namespace remap
