// Pixel types of image files, and their conversion to and from floats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace remap {

enum class PixelType { kUint8, kUint16, kUint32, kInt8, kInt16, kInt32, kHalf, kFloat, kDouble };

std::size_t byte_count(PixelType type) noexcept;
bool is_integer(PixelType type) noexcept;

// `uint8`, `half`, ...: the names on the command line and in OpenImageIO.
std::string_view pixel_type_name(PixelType type) noexcept;
std::optional<PixelType> pixel_type_from_name(std::string_view name) noexcept;

// Reads `count` values of `type` at intervals of `stride` bytes from `first`, which need not be aligned.
// Integers are divided by the largest of their type: 255 of uint8 becomes 1.
void load_values(PixelType type, const std::byte* first, std::size_t stride, std::size_t count,
                 float* values) noexcept;

// Writes values back, rounded to nearest. Integers are clipped to [0, 1] ([-1, 1] if signed), and NaN becomes
// 0. Returns the number of clipped values. Values that `load_values` read from an integer of at most 24 bits
// are restored bit for bit.
std::size_t store_values(PixelType type, const float* values, std::size_t count, std::byte* first,
                         std::size_t stride) noexcept;

// Conversion from and to IEEE 754 binary16, rounded to nearest even. Every half, including infinities and
// denormals, is exact.
float half_to_float(std::uint16_t half) noexcept;
std::uint16_t float_to_half(float value) noexcept;

}  // namespace remap
