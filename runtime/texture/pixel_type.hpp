// Pixel types of image files and the way between them and the floats that converters work on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

enum class PixelType { kUint8, kUint16, kUint32, kInt8, kInt16, kInt32, kHalf, kFloat, kDouble };

std::size_t byte_count(PixelType type) noexcept;
bool is_integer(PixelType type) noexcept;

// `uint8`, `half`, ...: the words of the command line and of OpenImageIO.
std::string_view pixel_type_name(PixelType type) noexcept;
std::optional<PixelType> pixel_type_from_name(std::string_view name) noexcept;
std::vector<std::string> pixel_type_names();

// Reads `count` values of `type` that lie `stride` bytes apart, starting at `first`, which need not be
// aligned. Integers become value / largest: 255 of uint8 is 1.
void load_values(PixelType type, const std::byte* first, std::size_t stride, std::size_t count,
                 float* values) noexcept;

// Writes them back, rounded to nearest. Integers are clipped to [0, 1] ([-1, 1] where signed), NaN becomes 0.
// Returns how many values were clipped. Values that `load_values` read from an integer of 24 bits or less
// come back bit for bit.
std::size_t store_values(PixelType type, const float* values, std::size_t count, std::byte* first,
                         std::size_t stride) noexcept;

// IEEE 754 binary16 and back, rounded to nearest even; exact for every half, infinities and denormals too.
float half_to_float(std::uint16_t half) noexcept;
std::uint16_t float_to_half(float value) noexcept;

}  // namespace remap
