// This file separates floats that are interleaved in texels into rows of one channel, and joins them again.
#pragma once

#include <cstddef>
#include <span>

namespace remap {

// Each texel has as many floats as there are rows: three or four.
void load_interleaved(const std::byte* texels, std::size_t count, std::span<float* const> rows) noexcept;
void store_interleaved(std::span<const float* const> rows, std::size_t count, std::byte* texels) noexcept;

}  // namespace remap
