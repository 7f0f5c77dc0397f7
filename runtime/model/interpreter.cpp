#include "model/interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace remap {
namespace {

// phi of the Parametric kind.
double rise(double rate, double x) { return rate == 0.0 ? x : -std::expm1(-rate * x) / rate; }

Range rounded_to_float(const Range& range) {
  return {static_cast<double>(static_cast<float>(range.min)),
          static_cast<double>(static_cast<float>(range.max))};
}

}  // namespace

double specular_slope(const Parametric& form, double alpha) {
  return form.start + form.ramp * rise(form.ramp_rate, alpha) +
         form.bump * rise(form.bump_rate, alpha * alpha);
}

MappedTexel evaluate_mapping(const MappingKind& mapping, double alpha, double specular) {
  struct Evaluate {
    double alpha, specular;
    MappedTexel operator()(const Parametric& form) const {
      const auto& r = form.roughness;
      const double alpha_out = (((r[3] * alpha + r[2]) * alpha + r[1]) * alpha + r[0]) * alpha;
      return {alpha_out, specular_slope(form, alpha) * specular};
    }
  };
  return std::visit(Evaluate{alpha, specular}, mapping);
}

double roughness_derivative(const MappingKind& mapping, double alpha) {
  struct Derivative {
    double alpha;
    double operator()(const Parametric& form) const {
      const auto& r = form.roughness;
      return ((4.0 * r[3] * alpha + 3.0 * r[2]) * alpha + 2.0 * r[1]) * alpha + r[0];
    }
  };
  return std::visit(Derivative{alpha}, mapping);
}

Range own_roughness_range(const Fit& fit) {
  const double a = from_alpha(fit.source.roughness, fit.domain.alpha.min);
  const double b = from_alpha(fit.source.roughness, fit.domain.alpha.max);
  return rounded_to_float({std::min(a, b), std::max(a, b)});
}

Range specular_range(const Fit& fit) { return rounded_to_float(fit.domain.specular); }

double evaluate_texel(const Fit& fit, double roughness, std::span<const double> specular,
                      std::span<double> specular_out, bool* in_domain) {
  const Range own = own_roughness_range(fit);
  const Range covered = specular_range(fit);
  bool inside = own.contains(roughness);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const bool defined = !std::isnan(roughness);
  const double alpha =
      to_alpha(fit.source.roughness, defined ? std::clamp(roughness, own.min, own.max) : own.min);

  double largest = 0.0;  // NaN channels take no part in the scale
  for (const double value : specular) {
    inside = inside && covered.contains(value);
    if (std::isfinite(value)) largest = std::max(largest, std::fabs(value));
  }
  const double scale = largest > covered.max ? largest / covered.max : 1.0;
  for (std::size_t c = 0; c < specular.size(); ++c) {
    const double mapped = scale * evaluate_mapping(fit.mapping, alpha, specular[c] / scale).specular;
    specular_out[c] = defined ? mapped : nan;
  }
  if (in_domain != nullptr) *in_domain = inside;
  return defined ? from_alpha(fit.target.roughness, evaluate_mapping(fit.mapping, alpha, 0.0).alpha) : nan;
}

}  // namespace remap
