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

}  // namespace

GgxLobe ggx_lobe(const LegacyMaterial& material) {
  const double exponent =
      std::clamp(material.exponent, LegacyMaterial::kLeastExponent, LegacyMaterial::kMostExponent);
  GgxLobe lobe;
  const auto n = static_cast<float>(exponent);
  lobe.roughness = decimal_value(std::pow(1.55f / (n + 4.17f), 0.25f));
  for (std::size_t c = 0; c < 3; ++c)
    lobe.f0[c] =
        decimal_value(std::min(1.0f, 6.02f * static_cast<float>(material.specular[c]) / (n + 1.86f)));
  return lobe;
}

MetalRoughFactors core_of_legacy(const LegacyMaterial& material) {
  const GgxLobe lobe = ggx_lobe(material);
  const double share = dielectric_share(mean_of(material.diffuse), mean_of(lobe.f0));
  // If F0 is below a fortieth of core's F0, the result approaches core_of_diffuse().
  const double matte = std::clamp(1.0 - 40.0 * *std::ranges::max_element(lobe.f0) / kDielectricF0, 0.0, 1.0);
  MetalRoughFactors core;
  for (std::size_t c = 0; c < 3; ++c)
    core.base_color[c] = static_cast<float>(
        std::clamp(material.diffuse[c] + lobe.f0[c] - kDielectricF0 * share * (1.0 - matte), 0.0, 1.0));
  core.metallic = static_cast<float>(1.0 - share);
  core.roughness = static_cast<float>(lobe.roughness + matte * (1.0 - lobe.roughness));
  return core;
}

MetalRoughFactors core_of_diffuse(const std::array<double, 3>& diffuse) {
  MetalRoughFactors core;
  for (std::size_t c = 0; c < 3; ++c) core.base_color[c] = static_cast<float>(diffuse[c]);
  core.metallic = 0.0f;
  return core;
}

LegacyDielectric dielectric_of_legacy(const LegacyMaterial& material) {
  // At least this fraction of light is transmitted to the diffuse lobe. Otherwise, a mirror would leave no
  // light for it. This was not measured for mirrors.
  constexpr double kLeastTransmitted = 0.02;
  const GgxLobe lobe = ggx_lobe(material);
  LegacyDielectric result;
  result.roughness = lobe.roughness;
  result.specular = *std::max_element(lobe.f0.begin(), lobe.f0.end());
  for (std::size_t c = 0; c < 3; ++c) {
    result.base_color[c] =
        std::min(1.0, material.diffuse[c] / std::max(1.0 - result.specular, kLeastTransmitted));
    result.specular_color[c] = result.specular > 0.0 ? lobe.f0[c] / result.specular : 1.0;
  }
  return result;
}

}  // namespace remap
