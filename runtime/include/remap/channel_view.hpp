// Views of the channels of maps in memory.
#pragma once

#include <cstddef>
#include <type_traits>

#include "remap/pixel_type.hpp"

namespace remap {

// One channel of a map in memory. The value of texel (x, y) is at first + y row_stride + x texel_stride and
// need not be aligned. Strides are in bytes; the row stride is negative for an image that is stored bottom
// up.
template <typename Byte>
struct BasicChannelView {
  Byte* first = nullptr;
  PixelType type = PixelType::kFloat;
  std::ptrdiff_t texel_stride = 0;
  std::ptrdiff_t row_stride = 0;

  operator BasicChannelView<const Byte>() const noexcept  // a writable channel is readable
      requires(!std::is_const_v<Byte>) {
    return {first, type, texel_stride, row_stride};
  }
};
using ChannelView = BasicChannelView<std::byte>;
using ConstChannelView = BasicChannelView<const std::byte>;

// A channel of packed rows of `width` texels with `values_a_texel` floats each. `first` points to the value
// of the first texel.
ChannelView float_channel(float* first, std::size_t width, std::size_t values_a_texel = 1) noexcept;
ConstChannelView float_channel(const float* first, std::size_t width,
                               std::size_t values_a_texel = 1) noexcept;

}  // namespace remap
