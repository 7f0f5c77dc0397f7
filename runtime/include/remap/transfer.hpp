// Decodes the numbers of a map for a converter: the transfer curve of a color, the encoding of a roughness.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "remap/convention.hpp"

namespace remap {

// The transfer curve from linear to stored values.
enum class Transfer {
  kLinear,
  kSrgb,  // IEC 61966-2-1, odd below 0 and extended by the same formula above 1
};

// `linear`, `srgb`.
std::string_view transfer_name(Transfer transfer);
std::optional<Transfer> transfer_from_name(std::string_view name);
std::vector<std::string> transfer_names();

// Converts stored values to linear ones and back, in place. NaN stays NaN.
void to_linear(Transfer transfer, std::span<float> values) noexcept;
void from_linear(Transfer transfer, std::span<float> values) noexcept;

// Converts roughness from one encoding to another, in place; equal encodings change nothing. Invalid values
// of `from` (below 0, and above 1 except for exponents) are clamped. The exponent of alpha 0 is infinite. NaN
// stays NaN.
void change_convention(RoughnessConvention from, RoughnessConvention to, std::span<float> widths) noexcept;

}  // namespace remap
