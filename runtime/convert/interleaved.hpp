// Colors whose three floats stand side by side in every texel, as rows of one channel, and back.
#pragma once

#include <array>
#include <cstddef>

namespace remap {

void load_interleaved(const std::byte* texels, std::size_t count, const std::array<float*, 3>& rows) noexcept;
void store_interleaved(const std::array<const float*, 3>& rows, std::size_t count,
                       std::byte* texels) noexcept;

}  // namespace remap
