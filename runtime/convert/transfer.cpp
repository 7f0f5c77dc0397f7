#include "convert/transfer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "convert/levels.hpp"
#include "remap/pixels.hpp"

namespace remap {
namespace {

// Computes the sRGB curve without the power function of the C library. That function takes most of the time
// of a conversion, and its results differ between libraries. This code has only sums, products, quotients and
// comparisons of doubles, so results are the same everywhere. It has no branch and no call, so that compilers
// vectorise the loops below.

constexpr std::uint64_t kOne = 0x3ff0000000000000;  // bits of 1.0
constexpr int kMantissaBits = 52;

// Returns the sum of c[i] x^i.
template <std::size_t Count>
constexpr double polynomial(const std::array<double, Count>& c, double x) noexcept {
  double sum = c[Count - 1];
  for (std::size_t i = Count - 1; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

// Returns the logarithm for normal values above 0, within 3e-14. It adds the exponent and a polynomial in ((m
// - 1) / (m + 1))^2. The mantissa m lies between the square roots of 1/2 and 2. The polynomial interpolates
// at Chebyshev nodes.
constexpr double log2_of(double value) noexcept {
  constexpr std::uint64_t kRootOfHalf = 0x3fe6a09e667f3bcd;
  constexpr std::uint64_t kBitsOf2To52 = 0x4330000000000000;
  constexpr std::array kFactors = {2.885390081777851,   0.9617966941122649,  0.5770779426603044,
                                   0.41220922406110433, 0.31990680380701336, 0.28288502340748234};
  const auto bits = __builtin_bit_cast(std::uint64_t, value);
  const std::uint64_t biased = (bits - kRootOfHalf + kOne) >> kMantissaBits;  // adds 1023 to the exponent
  const double exponent = __builtin_bit_cast(double, biased | kBitsOf2To52) - (0x1p52 + 1023.0);
  const auto mantissa = __builtin_bit_cast(double, bits - (biased << kMantissaBits) + kOne);
  const double t = (mantissa - 1.0) / (mantissa + 1.0);
  return exponent + t * polynomial(kFactors, t * t);
}

// Returns 2^x for x between -1000 and 1000, with a relative error below 2e-14. It multiplies the power of the
// closest integer by a polynomial for the rest, which interpolates at Chebyshev nodes.
constexpr double exp2_of(double x) noexcept {
  constexpr double kWhole = 0x1.8p52;  // x + kWhole is rounded to an integer, which is in the last bits
  constexpr std::array kFactors = {1.0000000000000135,    0.6931471805599462,     0.2402265069564034,
                                   0.05550410866465167,   0.009618129193934313,   0.0013333558200794592,
                                   0.0001540343375125101, 1.5252672924850737e-05, 1.325964524488711e-06,
                                   1.0205905413765595e-07};
  const double shifted = x + kWhole;
  const auto power =
      __builtin_bit_cast(double, (__builtin_bit_cast(std::uint64_t, shifted) << kMantissaBits) + kOne);
  return power * polynomial(kFactors, x - (shifted - kWhole));
}

// Converts a finite value of at least 0. Multiplies by reciprocals, because this is faster than dividing.
constexpr double magnitude_to_linear(double stored) noexcept {
  const double power = exp2_of(2.4 * log2_of((stored + 0.055) * (1.0 / 1.055)));
  const double line = stored * (1.0 / 12.92);
  return stored <= 0.04045 ? line : power;
}

constexpr double magnitude_to_srgb(double linear) noexcept {
  const double power = 1.055 * exp2_of(log2_of(linear) * (1.0 / 2.4)) - 0.055;
  const double line = linear * 12.92;
  return linear <= 0.0031308 ? line : power;
}

// Applies `change`, which is for finite values of at least 0, to all values: negative values keep their sign,
// and infinity and NaN stay unchanged.
template <typename Change>
void change_all(std::span<float> values, Change change) noexcept {
  for (float& value : values) {
    const float magnitude = std::fabs(value);
    const auto changed = static_cast<float>(change(static_cast<double>(magnitude)));
    const float result = magnitude <= std::numeric_limits<float>::max() ? changed : magnitude;
    value = std::copysign(result, value);
  }
}

// Returns the levels of the sRGB curve for 8 bits.
constexpr QuantizationTable srgb_levels() {
  QuantizationTable::Values values{}, least{};
  for (std::size_t i = 0; i < QuantizationTable::kCount; ++i) {
    values[i] = static_cast<float>(magnitude_to_linear(static_cast<double>(static_cast<float>(i) / 255.0f)));
    const double middle = magnitude_to_linear((static_cast<double>(i) + 0.5) / 255.0);
    const auto rounded = static_cast<float>(middle);
    const bool is_below = static_cast<double>(rounded) < middle;
    least[i] = __builtin_bit_cast(float, __builtin_bit_cast(std::uint32_t, rounded) + is_below);
  }
  return {values, least};
}
constexpr QuantizationTable kSrgbLevels = srgb_levels();

}  // namespace

void to_linear(Transfer transfer, std::span<float> values) noexcept {
  if (transfer == Transfer::kSrgb) change_all(values, magnitude_to_linear);
}

void from_linear(Transfer transfer, std::span<float> values) noexcept {
  if (transfer == Transfer::kSrgb) change_all(values, magnitude_to_srgb);
}

void load_linear(Transfer transfer, PixelType type, const std::byte* first, std::size_t stride,
                 std::size_t count, float* values) noexcept {
  if (transfer == Transfer::kSrgb && type == PixelType::kUint8)
    return kSrgbLevels.load(first, stride, count, values);
  load_values(type, first, stride, count, values);
  to_linear(transfer, {values, count});
}

std::size_t store_linear(Transfer transfer, PixelType type, const float* values, std::size_t count,
                         std::byte* first, std::size_t stride) noexcept {
  if (transfer == Transfer::kLinear) return store_values(type, values, count, first, stride);
  if (type == PixelType::kUint8) return kSrgbLevels.store(values, count, first, stride);
  std::array<float, 512> block;
  std::size_t clipped = 0;
  for (std::size_t begin = 0; begin < count; begin += block.size()) {
    const std::size_t size = std::min(block.size(), count - begin);
    std::copy_n(values + begin, size, block.begin());
    from_linear(transfer, {block.data(), size});
    clipped += store_values(type, block.data(), size, first + begin * stride, stride);
  }
  return clipped;
}

void change_convention(RoughnessEncoding from, RoughnessEncoding to, std::span<float> widths) noexcept {
  if (from == to) return;
  const float highest = from == RoughnessEncoding::kExponent ? INFINITY : 1.0f;
  for (float& width : widths) {
    if (std::isnan(width)) continue;
    const double clamped = static_cast<double>(std::clamp(width, 0.0f, highest));
    width = static_cast<float>(from_alpha(to, to_alpha(from, clamped)));
  }
}

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
