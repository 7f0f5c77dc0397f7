#include "study/lobe_bank.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace remap {
namespace {

constexpr std::size_t kWidthCount = 64, kExponentCount = 36, kMaterialCount = 40;
constexpr Range kWidthRange{0.01, 1.0}, kJudgedWidths{0.05, 1.0}, kExponents{0.1, 10000.0};
// Below, a lobe is wider than any of a target, and nobody writes it.
constexpr double kLeastJudgedExponent = 1.0;
constexpr double kCoreF0 = 0.04;

// `count` numbers of equal ratios.
std::vector<double> spread(const Range& range, std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(
        range.min * std::pow(range.max / range.min, static_cast<double>(i) / static_cast<double>(count - 1)));
  return values;
}

bool is_of(Half half, std::size_t index) { return (index % 2 == 0) == (half == Half::kChoosing); }

// From 0 to 1, the same on every machine.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

}  // namespace

bool has_exponent(const std::string& model) { return model.starts_with("legacy/"); }
bool is_mirrored(const std::string& model) { return model.find("blinn") == std::string::npos; }
bool is_normalised(const std::string& model) { return model.ends_with("-normalised"); }

// Reflectances are those that files hold: Kd and Ks from 0 to 1.
std::vector<LobeMaterial> exponent_materials(const std::string& model, Half half) {
  const std::vector<double> alphas = LobeBank::alphas(model);
  std::mt19937_64 random(half == Half::kChoosing ? 1 : 2);
  const auto between = [&](double low, double high) { return low + (high - low) * uniform(random); };
  std::vector<LobeMaterial> materials;
  for (std::size_t m = 0; m < kMaterialCount; ++m) {
    LobeMaterial material;
    const double grey = between(0.05, 1.0);
    for (std::size_t c = 0; c < 3; ++c) {
      material.diffuse[c] = m % 3 == 2 ? between(0.0, 0.2) : between(0.02, 0.8);
      material.specular[c] = m % 3 == 0 ? grey : m % 3 == 1 ? grey * between(0.5, 1.0) : between(0.3, 1.0);
    }
    for (std::size_t i = 0; i < alphas.size(); ++i) {
      if (!is_of(half, i)) continue;
      if (half == Half::kJudging &&
          from_alpha(RoughnessConvention::kExponent, alphas[i]) < kLeastJudgedExponent)
        continue;
      material.alpha = alphas[i];
      materials.push_back(material);
    }
  }
  return materials;
}

std::vector<LobeMaterial> width_materials(const std::string& model, Half half) {
  const std::vector<double> alphas = LobeBank::alphas(model);
  constexpr std::array kChoosing = {0.04, 0.2, 0.6};
  constexpr std::array kJudging = {0.04, 0.1, 0.3, 0.5, 0.9};
  std::vector<LobeMaterial> materials;
  const auto add = [&](const auto& speculars) {
    for (std::size_t i = 0; i < alphas.size(); ++i)
      for (const double specular : speculars)
        if (is_of(half, i) && kJudgedWidths.contains(alphas[i]))
          materials.push_back({alphas[i], {specular, specular, specular}, {}});
  };
  half == Half::kChoosing ? add(kChoosing) : add(kJudging);
  return materials;
}

std::vector<LobeMaterial> core_materials(const std::string& model, Half half) {
  const std::vector<double> alphas = LobeBank::alphas(model);
  std::mt19937_64 random(half == Half::kChoosing ? 3 : 4);
  std::vector<LobeMaterial> materials;
  for (std::size_t m = 0; m < kMaterialCount / 2; ++m) {
    Rgb color{};
    for (double& value : color) value = 0.02 + 0.9 * uniform(random);
    for (std::size_t i = 0; i < alphas.size(); ++i)
      if (is_of(half, i) && kJudgedWidths.contains(alphas[i])) {
        if (m % 2 == 0)
          materials.push_back(
              {alphas[i], {kCoreF0, kCoreF0, kCoreF0}, {0.96 * color[0], 0.96 * color[1], 0.96 * color[2]}});
        else
          materials.push_back({alphas[i], color, {}});
      }
  }
  return materials;
}

const LobePictures& LobeBank::of(const std::string& model) {
  std::unique_ptr<LobePictures>& pictures = pictures_[model];
  if (!pictures) pictures = std::make_unique<LobePictures>(lights_, model, alphas(model));
  return *pictures;
}

std::vector<double> LobeBank::alphas(const std::string& model) {
  if (!has_exponent(model)) return spread(kWidthRange, kWidthCount);
  std::vector<double> alphas;
  for (const double exponent : spread(kExponents, kExponentCount))
    alphas.push_back(to_alpha(RoughnessConvention::kExponent, exponent));
  std::ranges::sort(alphas);
  return alphas;
}

}  // namespace remap
