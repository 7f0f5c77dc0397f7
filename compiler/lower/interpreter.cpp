#include "lower/interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/number_text.hpp"
#include "lower/evaluate.hpp"

namespace remap {
namespace {

// The source alpha at which the mapping is evaluated.
double mapping_alpha(const Fit& fit, double alpha) {
  return fit.regimes.wide ? std::min(alpha, fit.regimes.wide->mapping_to) : alpha;
}

double clamped_value(const TexelSeries& series, double alpha, double specular) {
  const auto clamped = [](const Range& range, double value) {
    return std::clamp(value, range.min, range.max);
  };
  return series_value(series, clamped(series.alpha, alpha), clamped(series.specular, specular));
}

// The share of the regime that takes over where `value` passes `limit`.
double share_beyond(double value, double limit) {
  return std::clamp((value / limit - 1.0) / kSeam, 0.0, 1.0);
}

// Target specular without its limits.
double free_specular(const Fit& fit, double wide, double alpha, double specular) {
  const double inside =
      std::visit([&](const auto& kind) { return target_specular(kind, mapping_alpha(fit, alpha), specular); },
                 fit.mapping);
  if (wide == 0.0 || !fit.regimes.wide) return inside;
  return inside + wide * (clamped_value(fit.regimes.wide->specular, alpha, specular) - inside);
}

Range as_floats(const Range& range) { return {rounded_to_float(range.min), rounded_to_float(range.max)}; }

}  // namespace

MappedTexel evaluate_mapping(const MappingKind& mapping, double alpha, double specular) {
  return std::visit(
      [&](const auto& kind) {
        return MappedTexel{target_alpha(kind, alpha, specular), target_specular(kind, alpha, specular)};
      },
      mapping);
}

TexelWidth target_width(const Fit& fit, double alpha, double top) {
  const Regimes& regimes = fit.regimes;
  const double mapped = std::visit(
      [&](const auto& kind) { return target_alpha(kind, mapping_alpha(fit, alpha), top); }, fit.mapping);
  const double wide = share_beyond(mapped, regimes.alpha_limit);
  const double width = std::min(mapped, regimes.alpha_limit);
  if (!regimes.bright) return {width, wide, 0.0};
  const double bright = share_beyond(free_specular(fit, wide, alpha, top), *regimes.specular_limit);
  if (bright == 0.0) return {width, wide, 0.0};
  const double free = std::min(clamped_value(*regimes.bright, alpha, top), regimes.alpha_limit);
  return {width + bright * (free - width), wide, bright};
}

double target_channel(const Fit& fit, double wide, double alpha, double specular) {
  const double mapped = std::max(free_specular(fit, wide, alpha, specular), 0.0);
  return fit.regimes.specular_limit ? std::min(mapped, *fit.regimes.specular_limit) : mapped;
}

bool is_inside(const Fit& fit, double alpha, double specular) {
  const MappedTexel mapped = evaluate_mapping(fit.mapping, mapping_alpha(fit, alpha), specular);
  return mapped.alpha < fit.regimes.alpha_limit &&
         !(fit.regimes.specular_limit && mapped.specular >= *fit.regimes.specular_limit);
}

Domain mapping_domain(const Fit& fit) {
  Domain domain = fit.domain;
  domain.alpha.max = mapping_alpha(fit, domain.alpha.max);
  return domain;
}

MappedTexel evaluate_fit(const Fit& fit, double alpha, double specular) {
  const TexelWidth width = target_width(fit, alpha, specular);
  return {width.alpha, target_channel(fit, width.wide, alpha, specular)};
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
  const TexelWidth width = target_width(fit, alpha, largest / scale);
  for (std::size_t c = 0; c < specular.size(); ++c) {
    const bool passes = std::isnan(specular[c]) || specular[c] == std::numeric_limits<double>::infinity();
    specular_out[c] =
        passes ? specular[c]
               : scale * target_channel(fit, width.wide, alpha, std::max(specular[c], 0.0) / scale);
  }
  return from_alpha(fit.target.roughness, width.alpha);
}

}  // namespace remap
