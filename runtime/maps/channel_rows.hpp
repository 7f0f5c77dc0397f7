// Loads rows of floats from channels of maps in memory, and stores them.
#pragma once

#include <array>
#include <cstddef>

#include "remap/channel_view.hpp"

namespace remap {

// The number of texels converted at a time, so that their rows stay in the cache of one core.
inline constexpr std::size_t kSegment = 2048;
using FloatRow = std::array<float, kSegment>;

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
