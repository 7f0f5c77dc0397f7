#include "stages/dielectric_f0.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace remap {

namespace code = workflow_code;

bool has_nan(const SpecularMaterial& material) {
  const auto is_nan = [](float value) { return std::isnan(value); };
  return std::ranges::any_of(material.diffuse, is_nan) || std::ranges::any_of(material.specular, is_nan) ||
         is_nan(material.width);
}

code::Texel texel_of(const code::Conventions& use, const SpecularMaterial& material) {
  code::SpecularTexels texels{};
  std::array<std::array<float, code::kMetallicBlock>, 7> rows{};
  for (std::size_t c = 0; c < 3; ++c) {
    rows[c][0] = material.diffuse[c];
    rows[3 + c][0] = material.specular[c];
  }
  rows[6][0] = material.width;
  std::array<const float*, 7> in{};
  for (std::size_t r = 0; r < rows.size(); ++r) in[r] = rows[r].data();
  code::read_specular(use, in, texels);
  return code::texel_of(texels, code::width_to_alpha(use.width_in, texels.clamped.row[6][0]), 0);
}

namespace {

// Returns the root mean square of the residuals after the projection.
double mean_residual(const SpecularWorkflow& specular, MetallicWorkflow metallic,
                     std::span<const SpecularMaterial> materials, double f0) {
  metallic.dielectric_f0 = f0;
  const code::Conventions use = conventions_of(specular, metallic, true);
  double sum = 0.0;
  std::size_t count = 0;
  for (const SpecularMaterial& material : materials) {
    if (has_nan(material)) continue;
    const code::Texel texel = texel_of(use, material);
    sum += std::max(code::error_of(texel, use, code::best_share(texel, use, 0.0f)), 0.0f);
    ++count;
  }
  if (count == 0) throw input_error("dielectric F0: cannot be estimated from maps without a valid texel");
  return std::sqrt(sum / static_cast<double>(count));
}

// Returns the argument with the smallest value of a unimodal function, by golden sections (Kiefer 1953).
template <typename Function>
double least_argument(const Function& function, double low, double high) {
  constexpr double kGolden = 0.6180339887498949;
  for (int i = 0; i < 16; ++i) {
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    if (function(a) < function(b))
      high = b;
    else
      low = a;
  }
  return 0.5 * (low + high);
}

}  // namespace

DielectricF0 estimate_dielectric_f0(const SpecularWorkflow& specular, const MetallicWorkflow& metallic,
                                    std::span<const SpecularMaterial> materials) {
  constexpr double kLargest = 0.12, kStepOfF0 = 0.005, kBeside = 0.01, kCertain = 2.0;
  const auto residual = [&](double f0) { return mean_residual(specular, metallic, materials, f0); };
  double best = 0.0, least = residual(0.0);
  for (double f0 = kStepOfF0; f0 <= kLargest + 1e-9; f0 += kStepOfF0) {
    const double value = residual(f0);
    if (value >= least) continue;
    best = f0;
    least = value;
  }
  DielectricF0 found;
  found.f0 = least_argument(residual, std::max(best - kStepOfF0, 0.0), best + kStepOfF0);
  found.residual = residual(found.f0);
  const double beside = std::min(residual(std::max(found.f0 - kBeside, 0.0)), residual(found.f0 + kBeside));
  found.is_certain = beside > 1e-6 && beside >= kCertain * found.residual;
  return found;
}

}  // namespace remap
