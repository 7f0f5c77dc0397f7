// Linear values of stored ones, and back: the pixel type and the transfer curve at once.
#pragma once

#include <cstddef>

#include "remap/pixels.hpp"

namespace remap {

// Gives what load_values() and to_linear() give.
void load_linear(Transfer transfer, PixelType type, const std::byte* first, std::size_t stride,
                 std::size_t count, float* values) noexcept;

// Gives what from_linear() and store_values() give, except that sRGB of uint8 is rounded once: every float
// becomes the nearest level of the curve. Returns the number of clipped values.
std::size_t store_linear(Transfer transfer, PixelType type, const float* values, std::size_t count,
                         std::byte* first, std::size_t stride) noexcept;

}  // namespace remap
