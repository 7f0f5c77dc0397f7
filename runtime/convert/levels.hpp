// This file converts the 256 levels of an 8-bit map by tables. One table has the value of each level, the
// other the closest level of every float. This works for any rising curve whose levels between 2^e and
// 2^(e+1) are further apart than 2^e / 128.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace remap {

class QuantizationTable {
 public:
  static constexpr std::size_t kCount = 256;
  using Values = std::array<float, kCount>;

  // `values` are the values of the levels. Element i of `least` is the least float that is closer to level i
  // + 1 than to level i. The last element is beyond 1. Throws if one step has floats of three levels. A
  // constant then does not compile.
  constexpr QuantizationTable(const Values& values, const Values& least) : values_(values) {
    std::uint64_t level = 0;
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      while (__builtin_bit_cast(float, (kFirstStep + i) << kStepBits) >= least[level]) ++level;
      const float last = __builtin_bit_cast(float, (kFirstStep + i + 1) << kStepBits);
      if (level + 1 < kCount && last > least[level + 1])
        throw std::logic_error("levels: too near to each other");
      steps_[i] = ((level + 1) << 32) - __builtin_bit_cast(std::uint32_t, least[level]);
    }
  }

  void load(const std::byte* first, std::size_t stride, std::size_t count, float* values) const noexcept {
    for (std::size_t i = 0; i < count; ++i)
      values[i] = values_[std::to_integer<std::size_t>(first[i * stride])];
  }

  // Clips values to [0, 1] and turns NaN into 0. Returns the number of values that it changed.
  std::size_t store(const float* values, std::size_t count, std::byte* first,
                    std::size_t stride) const noexcept {
    std::array<std::uint32_t, 512> block;
    std::uint32_t clipped = 0;
    for (std::size_t begin = 0; begin < count; begin += block.size()) {
      const std::size_t size = std::min(block.size(), count - begin);
      for (std::size_t i = 0; i < size; ++i) {
        const float value = values[begin + i];
        const bool is_high_enough = value >= 0.0f, is_low_enough = value <= 1.0f;
        clipped += !(is_high_enough & is_low_enough);
        const float raised = value > kLeast ? value : kLeast;
        block[i] = __builtin_bit_cast(std::uint32_t, raised < 1.0f ? raised : 1.0f);
      }
      for (std::size_t i = 0; i < size; ++i)
        first[(begin + i) * stride] =
            static_cast<std::byte>((steps_[(block[i] >> kStepBits) - kFirstStep] + block[i]) >> 32);
    }
    return clipped;
  }

 private:
  // A step is all floats with the same upper 16 bits. The steps cover floats from 2^-13 to 1. 2^-13 is below
  // the middle of levels 0 and 1. No step has floats of more than two levels.
  static constexpr float kLeast = 0x1p-13f;
  static constexpr int kStepBits = 16;
  static constexpr std::uint32_t kFirstStep = __builtin_bit_cast(std::uint32_t, kLeast) >> kStepBits;
  static constexpr std::uint32_t kSteps =
      (__builtin_bit_cast(std::uint32_t, 1.0f) >> kStepBits) - kFirstStep + 1;

  Values values_;
  // An entry is added to the bits of a float. The upper 32 bits then are its level. The entry has the lower
  // of the step's two levels there, and its lower bits overflow if the float belongs to the next level.
  std::array<std::uint64_t, kSteps> steps_{};
};

}  // namespace remap
