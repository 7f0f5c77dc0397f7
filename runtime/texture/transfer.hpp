// What the numbers in a map mean before a converter takes them: the curve of a color space, the encoding of
// a width.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/convention.hpp"

namespace remap {

// How stored values follow linear ones.
enum class Transfer {
  kLinear,
  kSrgb,  // IEC 61966-2-1, continued as an odd function below 0 and as it is above 1
};

// `linear`, `srgb`.
std::string_view transfer_name(Transfer transfer);
std::optional<Transfer> transfer_from_name(std::string_view name);
std::vector<std::string> transfer_names();

// Stored values to linear ones and back, in place. NaN stays NaN.
void to_linear(Transfer transfer, std::span<float> values) noexcept;
void from_linear(Transfer transfer, std::span<float> values) noexcept;

// Widths of one convention as widths of another, in place; nothing changes where both are the same. Values
// that no width of `from` can have (below 0, and above 1 but for exponents) are held at the nearest that one
// can, and an exponent of width 0 is infinite. NaN stays NaN.
void change_convention(RoughnessConvention from, RoughnessConvention to, std::span<float> widths) noexcept;

}  // namespace remap
