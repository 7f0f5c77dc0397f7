// Decodes the numbers of a map for a converter: the transfer curve of a color, the encoding of a roughness.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "remap/convention.hpp"
#include "remap/named_values.hpp"
#include "remap/pixel_type.hpp"

namespace remap {

// The transfer curve from linear to stored values.
enum class Transfer {
  kLinear,
  kSrgb,  // IEC 61966-2-1, odd below 0 and extended by the same formula above 1
};
inline constexpr NamedValues<Transfer, 2> kTransfers = {
    {{Transfer::kLinear, "linear"}, {Transfer::kSrgb, "srgb"}}};

// How colors (base color, diffuse, specular) are stored unless a file or a user says otherwise: whole numbers
// in sRGB, floating-point numbers linear. Other parameters are data, which no curve applies to.
inline Transfer usual_color_transfer(PixelType type) noexcept {
  return is_integer(type) ? Transfer::kSrgb : Transfer::kLinear;
}

// The linear values of a parameter, as far as a map does not hold them.
struct ParameterValues {
  std::vector<float> constants;           // one, or one each for red, green and blue; used without a map
  std::vector<float> factors;             // of the linear values: none, one, or one per channel
  Transfer transfer = Transfer::kLinear;  // of the stored values

  // The factor of a channel.
  float factor(std::size_t channel) const {
    return factors.empty() ? 1.0f : factors[factors.size() == 1 ? 0 : channel];
  }
};

// Converts stored values to linear ones and back, in place, within 0.51 units in the last place of the
// formula and with the same bits on every machine. NaN stays NaN.
void to_linear(Transfer transfer, std::span<float> values) noexcept;
void from_linear(Transfer transfer, std::span<float> values) noexcept;

// Converts roughness from one encoding to another, in place; equal encodings change nothing. Invalid values
// of `from` (below 0, and above 1 except for exponents) are clamped. The exponent of alpha 0 is infinite. NaN
// stays NaN.
void change_convention(RoughnessConvention from, RoughnessConvention to, std::span<float> widths) noexcept;

}  // namespace remap
