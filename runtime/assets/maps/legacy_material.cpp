#include "assets/maps/legacy_material.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr double kDielectricF0 = 0.04;

double mean_of(const std::array<double, 3>& color) { return (color[0] + color[1] + color[2]) / 3.0; }

// Returns the dielectric fraction of a mixture that reflects `diffuse` and `specular`. Both are means over
// channels.
double dielectric_share(double diffuse, double specular) {
  const double sum = diffuse + specular;
  const double root = std::sqrt(std::max(0.0, sum * sum - 4.0 * kDielectricF0 * diffuse));
  return sum + root > 0.0 ? std::min(1.0, 2.0 * diffuse / (sum + root)) : 1.0;
}

float exponent_of(const LegacyMaterial& material) {
  return static_cast<float>(
      std::clamp(material.exponent, LegacyMaterial::kLeastExponent, LegacyMaterial::kMostExponent));
}

// Return values as files store them, in floats.
double as_float(double value) { return static_cast<double>(static_cast<float>(value)); }
std::array<double, 3> as_floats(const std::array<double, 3>& color) {
  return {as_float(color[0]), as_float(color[1]), as_float(color[2])};
}

}  // namespace

double ggx_roughness(const LegacyMaterial& material) {
  return decimal_value(std::pow(1.55f / (exponent_of(material) + 4.17f), 0.25f));
}

std::array<double, 3> ggx_f0(const LegacyMaterial& material) {
  std::array<double, 3> f0{};
  for (std::size_t c = 0; c < 3; ++c)
    f0[c] = decimal_value(
        std::min(1.0f, 6.02f * static_cast<float>(material.specular[c]) / (exponent_of(material) + 1.86f)));
  return f0;
}

MetalRoughFactors core_of_legacy(const LegacyMaterial& material) {
  if (!material.has_highlight()) return {as_floats(material.diffuse), 0.0, 1.0};
  const std::array<double, 3> f0 = ggx_f0(material);
  const double share = dielectric_share(mean_of(material.diffuse), mean_of(f0));
  // If F0 is below a fortieth of core's F0, the result approaches the result without a highlight.
  const double matte = std::clamp(1.0 - 40.0 * *std::ranges::max_element(f0) / kDielectricF0, 0.0, 1.0);
  const double roughness = ggx_roughness(material);
  std::array<double, 3> base{};
  for (std::size_t c = 0; c < 3; ++c)
    base[c] = std::clamp(material.diffuse[c] + f0[c] - kDielectricF0 * share * (1.0 - matte), 0.0, 1.0);
  return {as_floats(base), as_float(1.0 - share), as_float(roughness + matte * (1.0 - roughness))};
}

LegacyDielectric dielectric_of_legacy(const LegacyMaterial& material) {
  // At least this fraction of light is transmitted to the diffuse lobe. Otherwise, a mirror would leave no
  // light for it. This was not measured for mirrors.
  constexpr double kLeastTransmitted = 0.02;
  const std::array<double, 3> f0 = ggx_f0(material);
  LegacyDielectric result;
  result.roughness = ggx_roughness(material);
  result.specular = *std::ranges::max_element(f0);
  for (std::size_t c = 0; c < 3; ++c) {
    result.base_color[c] =
        std::min(1.0, material.diffuse[c] / std::max(1.0 - result.specular, kLeastTransmitted));
    result.specular_color[c] = result.specular > 0.0 ? f0[c] / result.specular : 1.0;
  }
  return result;
}

}  // namespace remap
