// Views of the channels of maps in memory, which load rows of floats and store them.
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
template <typename Float>
auto float_channel(Float* first, std::size_t width, std::size_t values_a_texel = 1) noexcept {
  using Byte = std::conditional_t<std::is_const_v<Float>, const std::byte, std::byte>;
  const auto texel = static_cast<std::ptrdiff_t>(values_a_texel * sizeof(float));
  return BasicChannelView<Byte>{reinterpret_cast<Byte*>(first), PixelType::kFloat, texel,
                                texel * static_cast<std::ptrdiff_t>(width)};
}

// Texels [x, x + count) of row y, counted from the first row of the buffers.
struct Segment {
  std::size_t x, y, count;
};

template <typename Byte>
Byte* at(const BasicChannelView<Byte>& view, std::size_t x, std::size_t y) {
  return view.first + static_cast<std::ptrdiff_t>(y) * view.row_stride +
         static_cast<std::ptrdiff_t>(x) * view.texel_stride;
}

inline void load(const ConstChannelView& view, const Segment& segment, float* values) {
  load_values(view.type, at(view, segment.x, segment.y), static_cast<std::size_t>(view.texel_stride),
              segment.count, values);
}

// Returns the number of values that an integer type clipped.
inline std::size_t store(const ChannelView& view, const Segment& segment, const float* values) {
  return store_values(view.type, values, segment.count, at(view, segment.x, segment.y),
                      static_cast<std::size_t>(view.texel_stride));
}

}  // namespace remap
