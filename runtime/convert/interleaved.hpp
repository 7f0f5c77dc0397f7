// Floats that stand side by side in every texel, as rows of one channel, and back.
#pragma once

#include <cstddef>
#include <span>

namespace remap {

// Texels of as many floats as there are rows: three or four.
void load_interleaved(const std::byte* texels, std::size_t count, std::span<float* const> rows) noexcept;
void store_interleaved(std::span<const float* const> rows, std::size_t count, std::byte* texels) noexcept;

}  // namespace remap
