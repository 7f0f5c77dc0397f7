#include "convert/interleaved.hpp"

#include <cstring>

namespace remap {
namespace {

constexpr std::size_t kTexel = 3 * sizeof(float);

// Four values at once: compilers make no vectors of steps of three floats for WebAssembly, and slow ones
// elsewhere.
using Four = float __attribute__((vector_size(16)));

Four four_at(const void* values) noexcept {
  Four four;
  std::memcpy(&four, values, sizeof four);
  return four;
}
void put(const Four& four, void* values) noexcept { std::memcpy(values, &four, sizeof four); }

}  // namespace

void load_interleaved(const std::byte* texels, std::size_t count,
                      const std::array<float*, 3>& rows) noexcept {
  const auto [red, green, blue] = rows;
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    const std::byte* const texel = texels + i * kTexel;
    // r0 g0 b0 r1, g1 b1 r2 g2, b2 r3 g3 b3
    const Four first = four_at(texel), second = four_at(texel + 16), third = four_at(texel + 32);
    put(__builtin_shufflevector(__builtin_shufflevector(first, second, 0, 3, 6, 6), third, 0, 1, 2, 5),
        red + i);
    put(__builtin_shufflevector(__builtin_shufflevector(first, second, 1, 4, 7, 7), third, 0, 1, 2, 6),
        green + i);
    put(__builtin_shufflevector(__builtin_shufflevector(first, second, 2, 5, 5, 5), third, 0, 1, 4, 7),
        blue + i);
  }
  for (; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      std::memcpy(rows[c] + i, texels + i * kTexel + c * sizeof(float), sizeof(float));
}

void store_interleaved(const std::array<const float*, 3>& rows, std::size_t count,
                       std::byte* texels) noexcept {
  const auto [red, green, blue] = rows;
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    std::byte* const texel = texels + i * kTexel;
    const Four r = four_at(red + i), g = four_at(green + i), b = four_at(blue + i);
    put(__builtin_shufflevector(__builtin_shufflevector(r, g, 0, 4, 1, 1), b, 0, 1, 4, 2), texel);
    put(__builtin_shufflevector(__builtin_shufflevector(r, g, 5, 2, 6, 6), b, 0, 5, 1, 2), texel + 16);
    put(__builtin_shufflevector(__builtin_shufflevector(r, g, 3, 7, 7, 7), b, 6, 0, 1, 7), texel + 32);
  }
  for (; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      std::memcpy(texels + i * kTexel + c * sizeof(float), rows[c] + i, sizeof(float));
}

}  // namespace remap
