#include "convert/interleaved.hpp"

#include <cstring>

namespace remap {
namespace {

// Works on four values at once. Without this type, compilers do not vectorise steps of three floats on
// WebAssembly, and make slow vectors elsewhere.
using Four = float __attribute__((vector_size(16)));

Four four_at(const void* values) noexcept {
  Four four;
  std::memcpy(&four, values, sizeof four);
  return four;
}
void put(const Four& four, void* values) noexcept { std::memcpy(values, &four, sizeof four); }

// Calls `fours` for each group of four texels, and `one` for each float of the last texels. Loading and
// storing both use this function.
template <typename Fours, typename One>
void for_texels(std::size_t count, std::size_t channels, Fours fours, One one) noexcept {
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) fours(i);
  for (; i < count; ++i)
    for (std::size_t c = 0; c < channels; ++c) one(i, c);
}

struct FourFours {
  Four first, second, third, fourth;
};

FourFours transposed(const FourFours& of) noexcept {
  const Four low = __builtin_shufflevector(of.first, of.second, 0, 4, 1, 5);
  const Four high = __builtin_shufflevector(of.first, of.second, 2, 6, 3, 7);
  const Four next_low = __builtin_shufflevector(of.third, of.fourth, 0, 4, 1, 5);
  const Four next_high = __builtin_shufflevector(of.third, of.fourth, 2, 6, 3, 7);
  return {__builtin_shufflevector(low, next_low, 0, 1, 4, 5),
          __builtin_shufflevector(low, next_low, 2, 3, 6, 7),
          __builtin_shufflevector(high, next_high, 0, 1, 4, 5),
          __builtin_shufflevector(high, next_high, 2, 3, 6, 7)};
}

void load_threes(const std::byte* texel, float* red, float* green, float* blue) noexcept {
  const Four first = four_at(texel), second = four_at(texel + 16), third = four_at(texel + 32);
  // The three vectors hold r0 g0 b0 r1, g1 b1 r2 g2, b2 r3 g3 b3.
  put(__builtin_shufflevector(__builtin_shufflevector(first, second, 0, 3, 6, 6), third, 0, 1, 2, 5), red);
  put(__builtin_shufflevector(__builtin_shufflevector(first, second, 1, 4, 7, 7), third, 0, 1, 2, 6), green);
  put(__builtin_shufflevector(__builtin_shufflevector(first, second, 2, 5, 5, 5), third, 0, 1, 4, 7), blue);
}

void store_threes(const float* red, const float* green, const float* blue, std::byte* texel) noexcept {
  const Four r = four_at(red), g = four_at(green), b = four_at(blue);
  put(__builtin_shufflevector(__builtin_shufflevector(r, g, 0, 4, 1, 1), b, 0, 1, 4, 2), texel);
  put(__builtin_shufflevector(__builtin_shufflevector(r, g, 5, 2, 6, 6), b, 0, 5, 1, 2), texel + 16);
  put(__builtin_shufflevector(__builtin_shufflevector(r, g, 3, 7, 7, 7), b, 6, 0, 1, 7), texel + 32);
}

}  // namespace

void load_interleaved(const std::byte* texels, std::size_t count, std::span<float* const> rows) noexcept {
  const std::size_t channels = rows.size(), size = channels * sizeof(float);
  const auto one = [=](std::size_t i, std::size_t c) {
    std::memcpy(rows[c] + i, texels + i * size + c * sizeof(float), sizeof(float));
  };
  float *const red = rows[0], *const green = rows[1], *const blue = rows[2];
  if (channels == 3)
    return for_texels(
        count, channels, [=](std::size_t i) { load_threes(texels + 12 * i, red + i, green + i, blue + i); },
        one);
  float* const alpha = rows[3];
  for_texels(
      count, channels,
      [=](std::size_t i) {
        const std::byte* const texel = texels + 16 * i;
        const FourFours four =
            transposed({four_at(texel), four_at(texel + 16), four_at(texel + 32), four_at(texel + 48)});
        put(four.first, red + i);
        put(four.second, green + i);
        put(four.third, blue + i);
        put(four.fourth, alpha + i);
      },
      one);
}

void store_interleaved(std::span<const float* const> rows, std::size_t count, std::byte* texels) noexcept {
  const std::size_t channels = rows.size(), size = channels * sizeof(float);
  const auto one = [=](std::size_t i, std::size_t c) {
    std::memcpy(texels + i * size + c * sizeof(float), rows[c] + i, sizeof(float));
  };
  const float *const red = rows[0], *const green = rows[1], *const blue = rows[2];
  if (channels == 3)
    return for_texels(
        count, channels, [=](std::size_t i) { store_threes(red + i, green + i, blue + i, texels + 12 * i); },
        one);
  const float* const alpha = rows[3];
  for_texels(
      count, channels,
      [=](std::size_t i) {
        std::byte* const texel = texels + 16 * i;
        const FourFours four =
            transposed({four_at(red + i), four_at(green + i), four_at(blue + i), four_at(alpha + i)});
        put(four.first, texel);
        put(four.second, texel + 16);
        put(four.third, texel + 32);
        put(four.fourth, texel + 48);
      },
      one);
}

}  // namespace remap
