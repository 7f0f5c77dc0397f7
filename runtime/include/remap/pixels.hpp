// This file describes maps in memory: pixels, channels and their transfer functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "remap/model.hpp"

namespace remap {

// The following functions convert the pixel types of image files to and from floats.

enum class PixelType { kUint8, kUint16, kUint32, kInt8, kInt16, kInt32, kHalf, kFloat, kDouble };
// These are the names on the command line and in OpenImageIO.
inline constexpr NamedValues<PixelType, 9> kPixelTypes = {{{PixelType::kUint8, "uint8"},
                                                           {PixelType::kUint16, "uint16"},
                                                           {PixelType::kUint32, "uint"},
                                                           {PixelType::kInt8, "int8"},
                                                           {PixelType::kInt16, "int16"},
                                                           {PixelType::kInt32, "int"},
                                                           {PixelType::kHalf, "half"},
                                                           {PixelType::kFloat, "float"},
                                                           {PixelType::kDouble, "double"}}};

std::size_t byte_count(PixelType type) noexcept;
bool is_integer(PixelType type) noexcept;

// Reads `count` values of `type` at intervals of `stride` bytes from `first`, which need not be aligned.
// Integers are divided by the largest value of their type, so that 255 of uint8 becomes 1.
void load_values(PixelType type, const std::byte* first, std::size_t stride, std::size_t count,
                 float* values) noexcept;

// Writes values, rounded to the closest number. Integers are clipped to [0, 1] ([-1, 1] if signed), and NaN
// becomes 0. Returns the number of clipped values. If `load_values` read the values from integers of at most
// 24 bits, the bits are the same again.
std::size_t store_values(PixelType type, const float* values, std::size_t count, std::byte* first,
                         std::size_t stride) noexcept;

// These functions convert from and to IEEE 754 binary16, rounded to nearest even. Every half float, including
// infinities and denormals, is exact.
float half_to_float(std::uint16_t half) noexcept;
std::uint16_t float_to_half(float value) noexcept;

// The following views of channels in memory load rows of floats and store them.

// A BasicChannelView is one channel of a map in memory. The value of texel (x, y) is at first + y row_stride
// + x texel_stride and need not be aligned. Strides are in bytes; the row stride is negative if the image is
// stored bottom up.
template <typename Byte>
struct BasicChannelView {
  Byte* first = nullptr;
  PixelType type = PixelType::kFloat;
  std::ptrdiff_t texel_stride = 0;
  std::ptrdiff_t row_stride = 0;

  operator BasicChannelView<const Byte>() const noexcept  // a writable channel is readable
      requires(!std::is_const_v<Byte>) {
    return {first, type, texel_stride, row_stride};
  }
};
using ChannelView = BasicChannelView<std::byte>;
using ConstChannelView = BasicChannelView<const std::byte>;

// Returns a channel of packed rows of `width` texels with `values_a_texel` floats each. `first` points to the
// value of the first texel.
template <typename Float>
auto float_channel(Float* first, std::size_t width, std::size_t values_a_texel = 1) noexcept {
  using Byte = std::conditional_t<std::is_const_v<Float>, const std::byte, std::byte>;
  const auto texel = static_cast<std::ptrdiff_t>(values_a_texel * sizeof(float));
  return BasicChannelView<Byte>{reinterpret_cast<Byte*>(first), PixelType::kFloat, texel,
                                texel * static_cast<std::ptrdiff_t>(width)};
}

// A Segment is the texels [x, x + count) of row y, counted from the first row of the buffers.
struct Segment {
  std::size_t x, y, count;
};

template <typename Byte>
Byte* at(const BasicChannelView<Byte>& view, std::size_t x, std::size_t y) {
  return view.first + static_cast<std::ptrdiff_t>(y) * view.row_stride +
         static_cast<std::ptrdiff_t>(x) * view.texel_stride;
}

inline void load(const ConstChannelView& view, const Segment& segment, float* values) {
  load_values(view.type, at(view, segment.x, segment.y), static_cast<std::size_t>(view.texel_stride),
              segment.count, values);
}

// Returns the number of values that an integer type clipped.
inline std::size_t store(const ChannelView& view, const Segment& segment, const float* values) {
  return store_values(view.type, values, segment.count, at(view, segment.x, segment.y),
                      static_cast<std::size_t>(view.texel_stride));
}

// The rest of the file is about decoding the numbers of a map for a converter: curves of colors, and
// encodings of roughness.

// A Transfer is a curve from linear to stored values.
enum class Transfer {
  kLinear,
  kSrgb,  // IEC 61966-2-1; below 0 the curve is odd, above 1 the same formula continues
};
inline constexpr NamedValues<Transfer, 2> kTransfers = {
    {{Transfer::kLinear, "linear"}, {Transfer::kSrgb, "srgb"}}};

// Returns how colors (base color, diffuse, specular) are usually stored: integers in sRGB, floating-point
// numbers linear. A file or a user may override this. Other parameters are data, which no curve applies to.
inline Transfer usual_color_transfer(PixelType type) noexcept {
  return is_integer(type) ? Transfer::kSrgb : Transfer::kLinear;
}

// A ParameterValues holds what is needed, besides a map, to get linear values of a parameter.
struct ParameterValues {
  std::vector<float> constants;           // one value, or red, green and blue; used if there is no map
  std::vector<float> factors;             // factors of the linear values: none, one, or one per channel
  Transfer transfer = Transfer::kLinear;  // curve of the stored values

  float factor(std::size_t channel) const {
    return factors.empty() ? 1.0f : factors[factors.size() == 1 ? 0 : channel];
  }
};

// These functions convert stored values to linear values, or linear values to stored values, in place. They
// are within 0.51 units in the last place of the formula, and give the same bits on every machine. NaN stays
// NaN.
void to_linear(Transfer transfer, std::span<float> values) noexcept;
void from_linear(Transfer transfer, std::span<float> values) noexcept;

// Converts roughness from one encoding to another, in place; equal encodings change nothing. Invalid values
// of `from` (below 0, and above 1 except for exponents) are clamped. The exponent of alpha 0 is infinite. NaN
// stays NaN.
void change_convention(RoughnessEncoding from, RoughnessEncoding to, std::span<float> widths) noexcept;

}  // namespace remap
