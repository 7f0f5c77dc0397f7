// Decodes the numbers of a map for a converter: the transfer curve of a color, the encoding of a roughness.
#pragma once

#include <span>

#include "model/convention.hpp"
#include "text/named_values.hpp"

namespace remap {

// The transfer curve from linear to stored values.
enum class Transfer {
  kLinear,
  kSrgb,  // IEC 61966-2-1, odd below 0 and extended by the same formula above 1
};
inline constexpr NamedValues<Transfer, 2> kTransfers = {
    {{Transfer::kLinear, "linear"}, {Transfer::kSrgb, "srgb"}}};

// Converts stored values to linear ones and back, in place. NaN stays NaN.
void to_linear(Transfer transfer, std::span<float> values) noexcept;
void from_linear(Transfer transfer, std::span<float> values) noexcept;

// Converts roughness from one encoding to another, in place; equal encodings change nothing. Invalid values
// of `from` (below 0, and above 1 except for exponents) are clamped. The exponent of alpha 0 is infinite. NaN
// stays NaN.
void change_convention(RoughnessConvention from, RoughnessConvention to, std::span<float> widths) noexcept;

}  // namespace remap
