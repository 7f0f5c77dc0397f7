#include "remap/transfer.hpp"

#include <algorithm>
#include <cmath>

#include "text/named_values.hpp"

namespace remap {
namespace {

constexpr NamedValues<Transfer, 2> kTransfers = {{{Transfer::kLinear, "linear"}, {Transfer::kSrgb, "srgb"}}};

float srgb_to_linear(float stored) noexcept {
  const float magnitude = std::fabs(stored);
  const float linear =
      magnitude <= 0.04045f ? magnitude / 12.92f : std::pow((magnitude + 0.055f) / 1.055f, 2.4f);
  return std::copysign(linear, stored);
}

float linear_to_srgb(float linear) noexcept {
  const float magnitude = std::fabs(linear);
  const float stored =
      magnitude <= 0.0031308f ? magnitude * 12.92f : 1.055f * std::pow(magnitude, 1.0f / 2.4f) - 0.055f;
  return std::copysign(stored, linear);
}

}  // namespace

std::string_view transfer_name(Transfer transfer) { return name_of(kTransfers, transfer); }

std::optional<Transfer> transfer_from_name(std::string_view name) { return value_named(kTransfers, name); }

std::vector<std::string> transfer_names() { return names_of(kTransfers); }

void to_linear(Transfer transfer, std::span<float> values) noexcept {
  if (transfer == Transfer::kLinear) return;
  for (float& value : values) value = srgb_to_linear(value);
}

void from_linear(Transfer transfer, std::span<float> values) noexcept {
  if (transfer == Transfer::kLinear) return;
  for (float& value : values) value = linear_to_srgb(value);
}

void change_convention(RoughnessConvention from, RoughnessConvention to, std::span<float> widths) noexcept {
  if (from == to) return;
  const float highest = from == RoughnessConvention::kExponent ? INFINITY : 1.0f;
  for (float& width : widths) {
    if (std::isnan(width)) continue;
    const double held = static_cast<double>(std::clamp(width, 0.0f, highest));
    width = static_cast<float>(from_alpha(to, to_alpha(from, held)));
  }
}

}  // namespace remap
