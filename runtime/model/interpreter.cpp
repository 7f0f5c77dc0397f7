#include "model/interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/evaluate.hpp"
#include "text/number_text.hpp"

namespace remap {
namespace {

Range as_floats(const Range& range) { return {rounded_to_float(range.min), rounded_to_float(range.max)}; }

}  // namespace

MappedTexel evaluate_mapping(const MappingKind& mapping, double alpha, double specular) {
  return std::visit(
      [&](const auto& kind) {
        return MappedTexel{target_alpha(kind, alpha, specular), target_specular(kind, alpha, specular)};
      },
      mapping);
}

Range own_roughness_range(const Fit& fit) {
  const double a = from_alpha(fit.source.roughness, fit.domain.alpha.min);
  const double b = from_alpha(fit.source.roughness, fit.domain.alpha.max);
  return as_floats({std::min(a, b), std::max(a, b)});
}

Range specular_range(const Fit& fit) { return as_floats(fit.domain.specular); }

double evaluate_texel(const Fit& fit, double roughness, std::span<const double> specular,
                      std::span<double> specular_out, bool* in_domain) {
  const Range own = own_roughness_range(fit), covered = specular_range(fit);
  bool inside = own.contains(roughness);
  double largest = 0.0;  // channels that are not finite take no part in the scale
  for (const double value : specular) {
    inside = inside && covered.contains(value);
    if (std::isfinite(value)) largest = std::max(largest, value);
  }
  if (in_domain != nullptr) *in_domain = inside;
  if (std::isnan(roughness)) {
    std::fill(specular_out.begin(), specular_out.end(), std::numeric_limits<double>::quiet_NaN());
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double alpha = to_alpha(fit.source.roughness, std::clamp(roughness, own.min, own.max));
  const double scale = std::max(1.0, largest / covered.max);
  const auto evaluate = [&](const auto& kind) {
    for (std::size_t c = 0; c < specular.size(); ++c) {
      const bool passes = std::isnan(specular[c]) || specular[c] == std::numeric_limits<double>::infinity();
      specular_out[c] =
          passes ? specular[c]
                 : scale * std::max(target_specular(kind, alpha, std::max(specular[c], 0.0) / scale), 0.0);
    }
    return from_alpha(fit.target.roughness, target_alpha(kind, alpha, largest / scale));
  };
  return std::visit(evaluate, fit.mapping);
}

}  // namespace remap
