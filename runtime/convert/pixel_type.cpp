#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "convert/levels.hpp"
#include "remap/pixels.hpp"

namespace remap {
namespace {

// A HalfBits holds the bits of a half float, so that the templates below can distinguish it from uint16_t.
struct HalfBits {
  std::uint16_t bits;
};

template <typename Stored>
constexpr float to_float(Stored stored) noexcept {
  if constexpr (std::is_same_v<Stored, HalfBits>) {
    return half_to_float(stored.bits);
  } else if constexpr (std::is_integral_v<Stored>) {
    // Divides larger integers as double, because a float has only 24 bits.
    using Real = std::conditional_t<(sizeof(Stored) > 2), double, float>;
    return static_cast<float>(static_cast<Real>(stored) /
                              static_cast<Real>(std::numeric_limits<Stored>::max()));
  } else {
    return static_cast<float>(stored);
  }
}

template <typename Stored>
Stored from_float(float value) noexcept {
  if constexpr (std::is_same_v<Stored, HalfBits>) {
    return {float_to_half(value)};
  } else if constexpr (std::is_integral_v<Stored>) {
    // The product is exact in double, so the sum below rounds to the closest value.
    constexpr double kHighest = static_cast<double>(std::numeric_limits<Stored>::max());
    constexpr double kLowest = std::is_signed_v<Stored> ? -1.0 : 0.0;
    double clipped = value == value ? static_cast<double>(value) : 0.0;
    clipped = clipped > kLowest ? clipped : kLowest;
    clipped = clipped < 1.0 ? clipped : 1.0;
    const double scaled = clipped * kHighest;
    return static_cast<Stored>(scaled + (scaled < 0.0 ? -0.5 : 0.5));
  } else {
    return static_cast<Stored>(value);
  }
}

// Calls `work` with the stride. If values have no gaps, the stride is a constant, so that compilers vectorise
// the loops.
template <std::size_t kSize, typename Work>
void with_stride(std::size_t stride, Work work) noexcept {
  if (stride == kSize) return work(std::integral_constant<std::size_t, kSize>{});
  work(stride);
}

template <typename Stored>
void load(const std::byte* first, std::size_t stride, std::size_t count, float* values) noexcept {
  with_stride<sizeof(Stored)>(stride, [=](auto step) {
    for (std::size_t i = 0; i < count; ++i) {
      Stored stored;
      std::memcpy(&stored, first + i * step, sizeof stored);
      values[i] = to_float(stored);
    }
  });
}

template <typename Stored>
std::size_t store(const float* values, std::size_t count, std::byte* first, std::size_t stride) noexcept {
  with_stride<sizeof(Stored)>(stride, [=](auto step) {
    for (std::size_t i = 0; i < count; ++i) {
      const Stored stored = from_float<Stored>(values[i]);
      std::memcpy(first + i * step, &stored, sizeof stored);
    }
  });
  if constexpr (!std::is_integral_v<Stored>) return 0;
  constexpr float kLowest = std::is_signed_v<Stored> ? -1.0f : 0.0f;
  std::size_t clipped = 0;
  for (std::size_t i = 0; i < count; ++i) clipped += !(values[i] >= kLowest && values[i] <= 1.0f);
  return clipped;
}

// Calls `work` with a value of the C++ type for `type`.
template <typename Work>
auto with_storage(PixelType type, Work work) noexcept {
  switch (type) {
    case PixelType::kUint8:
      return work(std::uint8_t{});
    case PixelType::kUint16:
      return work(std::uint16_t{});
    case PixelType::kUint32:
      return work(std::uint32_t{});
    case PixelType::kInt8:
      return work(std::int8_t{});
    case PixelType::kInt16:
      return work(std::int16_t{});
    case PixelType::kInt32:
      return work(std::int32_t{});
    case PixelType::kHalf:
      return work(HalfBits{});
    case PixelType::kFloat:
      return work(float{});
    case PixelType::kDouble:
      return work(double{});
  }
  return work(float{});
}

constexpr QuantizationTable linear_levels() {
  QuantizationTable::Values values{}, least{};
  for (std::size_t i = 0; i < QuantizationTable::kCount; ++i) {
    values[i] = to_float(static_cast<std::uint8_t>(i));
    const double middle = static_cast<double>(i) + 0.5;
    auto bits = __builtin_bit_cast(std::uint32_t, static_cast<float>(middle / 255.0)) - 1;
    while (static_cast<double>(__builtin_bit_cast(float, bits)) * 255.0 < middle) ++bits;
    least[i] = __builtin_bit_cast(float, bits);
  }
  return {values, least};
}
constexpr QuantizationTable kLinearLevels = linear_levels();

}  // namespace

std::size_t byte_count(PixelType type) noexcept {
  return with_storage(type, [](auto stored) { return sizeof stored; });
}

bool is_integer(PixelType type) noexcept {
  return type != PixelType::kHalf && type != PixelType::kFloat && type != PixelType::kDouble;
}

void load_values(PixelType type, const std::byte* first, std::size_t stride, std::size_t count,
                 float* values) noexcept {
  if (type == PixelType::kUint8) return kLinearLevels.load(first, stride, count, values);
  with_storage(type, [&](auto stored) { load<decltype(stored)>(first, stride, count, values); });
}

std::size_t store_values(PixelType type, const float* values, std::size_t count, std::byte* first,
                         std::size_t stride) noexcept {
  if (type == PixelType::kUint8) return kLinearLevels.store(values, count, first, stride);
  return with_storage(type,
                      [&](auto stored) { return store<decltype(stored)>(values, count, first, stride); });
}

// The code has no branches, so that compilers vectorise the loops above. The method is by F. Giesen ("Half to
// float done quic", 2012, and "Float to half, round to nearest even"). An integer addition changes the
// exponent. For denormals, a float addition or subtraction of a power of two aligns the mantissas.
float half_to_float(std::uint16_t half) noexcept {
  constexpr std::uint32_t kExponentShift = std::uint32_t{127 - 15} << 23;  // difference of the biases
  constexpr std::uint32_t kHalfExponent = std::uint32_t{0x7c00} << 13;
  const std::uint32_t magnitude = static_cast<std::uint32_t>(half & 0x7fff) << 13;
  const std::uint32_t exponent = magnitude & kHalfExponent;
  const std::uint32_t normal = magnitude + kExponentShift;
  const std::uint32_t infinite = normal + kExponentShift;  // infinity and NaN keep the largest exponent
  const float smallest_normal = __builtin_bit_cast(float, std::uint32_t{113} << 23);  // 2^-14
  const float denormal = __builtin_bit_cast(float, normal + (std::uint32_t{1} << 23)) - smallest_normal;
  std::uint32_t bits = normal;
  bits = exponent == kHalfExponent ? infinite : bits;
  bits = exponent == 0 ? __builtin_bit_cast(std::uint32_t, denormal) : bits;
  return __builtin_bit_cast(float, bits | static_cast<std::uint32_t>(half & 0x8000) << 16);
}

std::uint16_t float_to_half(float value) noexcept {
  const std::uint32_t all = __builtin_bit_cast(std::uint32_t, value);
  const std::uint32_t sign = all & 0x80000000u;
  const std::uint32_t magnitude = all ^ sign;
  constexpr std::uint32_t kInfinity = std::uint32_t{255} << 23;
  constexpr std::uint32_t kHalfOverflow = std::uint32_t{127 + 16} << 23;        // 65536
  constexpr std::uint32_t kHalfSmallestNormal = std::uint32_t{127 - 14} << 23;  // 2^-14
  // This is 0.5. The last bit of floats near 0.5 means 2^-24, the step of half denormals. So adding this
  // number rounds to a half denormal.
  constexpr std::uint32_t kDenormalMagic = std::uint32_t{(127 - 15) + (23 - 10) + 1} << 23;
  const float lined_up = __builtin_bit_cast(float, magnitude) + __builtin_bit_cast(float, kDenormalMagic);
  const std::uint32_t denormal = __builtin_bit_cast(std::uint32_t, lined_up) - kDenormalMagic;
  // Adds half of the dropped part minus one, plus the last kept bit, so that ties round to even.
  const std::uint32_t odd = (magnitude >> 13) & 1u;
  const std::uint32_t normal = (magnitude - (std::uint32_t{127 - 15} << 23) + 0xfffu + odd) >> 13;
  const std::uint32_t special = magnitude > kInfinity ? 0x7e00u : 0x7c00u;  // quiet NaN or infinity
  std::uint32_t bits = normal;
  bits = magnitude < kHalfSmallestNormal ? denormal : bits;
  bits = magnitude >= kHalfOverflow ? special : bits;
  return static_cast<std::uint16_t>(bits | sign >> 16);
}

}  // namespace remap
