// This file converts stored values to linear values and linear values to stored values. It treats pixel type
// and transfer curve in one step.
#pragma once

#include <cstddef>

#include "remap/pixels.hpp"

namespace remap {

// Gives the results of load_values() followed by to_linear().
void load_linear(Transfer transfer, PixelType type, const std::byte* first, std::size_t stride,
                 std::size_t count, float* values) noexcept;

// Gives the results of from_linear() followed by store_values(). Only sRGB in uint8 differs, because it is
// rounded once: every float becomes the closest level of the curve. Returns the number of clipped values.
std::size_t store_linear(Transfer transfer, PixelType type, const float* values, std::size_t count,
                         std::byte* first, std::size_t stride) noexcept;

}  // namespace remap
