// This file converts stored values to linear values and linear values to stored values. It treats pixel type
// and transfer curve in one step. Interleaved floats become rows of one channel.
#pragma once

#include <cstddef>
#include <span>

#include "remap/pixels.hpp"

namespace remap {

// Gives the results of load_values() followed by to_linear().
void load_linear(Transfer transfer, PixelType type, const std::byte* first, std::size_t stride,
                 std::size_t count, float* values) noexcept;

// Gives the results of from_linear() followed by store_values(). Only sRGB in uint8 differs, because it is
// rounded once: every float becomes the closest level of the curve. Returns the number of clipped values.
std::size_t store_linear(Transfer transfer, PixelType type, const float* values, std::size_t count,
                         std::byte* first, std::size_t stride) noexcept;

// Each texel has as many floats as there are rows: three or four.
void load_interleaved(const std::byte* texels, std::size_t count, std::span<float* const> rows) noexcept;
void store_interleaved(std::span<const float* const> rows, std::size_t count, std::byte* texels) noexcept;

}  // namespace remap
