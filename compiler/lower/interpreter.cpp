#include "lower/interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/number_text.hpp"
#include "lower/evaluate.hpp"

namespace remap {
namespace {

Range as_floats(const Range& range) { return {rounded_to_float(range.min), rounded_to_float(range.max)}; }

// A Rule holds the factors of a mapping, and what the target does at its limits. A missing limit is infinite.
struct Rule {
  const MappingKind& mapping;
  const Domain& domain;
  double alpha_limit = INFINITY, specular_limit = INFINITY;
  Hinge hinge;

  // Return the factors for a texel in the domain. A specular of 0 is replaced by a tiny value, because the
  // factor is a quotient.
  double alpha_factor(double alpha, double specular) const {
    return std::visit([&](const auto& kind) { return target_alpha(kind, alpha, specular); }, mapping) / alpha;
  }
  double specular_factor(double alpha, double specular) const {
    const double s = std::max(specular, 1e-9 * domain.specular.max);
    return std::visit([&](const auto& kind) { return target_specular(kind, alpha, s); }, mapping) / s;
  }

  // Returns the target's alpha and changes `speculars` in place. They must be finite and at least 0.
  double operator()(double alpha, std::span<double> speculars) const {
    const double inside = std::max(alpha, domain.alpha.min);
    const auto factor = [&](double covered) { return std::max(specular_factor(inside, covered), 0.0); };
    double top = domain.specular.min;
    for (double& specular : speculars) {
      const double covered = std::clamp(specular, domain.specular.min, domain.specular.max);
      top = std::max(top, covered);
      specular *= factor(covered);
    }
    const double free = alpha * alpha_factor(inside, top);
    const double excess = std::max(top * factor(top) / specular_limit - 1.0, 0.0);
    const double over = excess / (1.0 + static_cast<double>(hinge.bend) * excess);
    const double turn = static_cast<double>(hinge.turn) + static_cast<double>(hinge.turn_by_alpha) * inside;
    const double wide = std::max(free / alpha_limit - 1.0, 0.0);
    for (double& specular : speculars)
      specular = std::min(specular * (1.0 + static_cast<double>(hinge.spread) * wide), specular_limit);
    return std::min(std::max(free + alpha * over * turn, 0.0), alpha_limit);
  }
};

double limit_of(const std::optional<float>& limit) { return limit ? static_cast<double>(*limit) : INFINITY; }

Rule rule_of(const Fit& fit) {
  if (const auto* form = std::get_if<CompactForm>(&fit.mapping))
    return {fit.mapping, fit.domain, limit_of(form->alpha_limit), limit_of(form->specular_limit),
            form->hinge};
  return {fit.mapping, fit.domain, fit.limits.alpha, fit.limits.specular.value_or(INFINITY), {}};
}

MappedTexel grey(const Rule& rule, double alpha, double specular) {
  double value = specular;
  const double width = rule(alpha, {&value, 1});
  return {width, value};
}

}  // namespace

MappedTexel evaluate_mapping(const MappingKind& mapping, double alpha, double specular) {
  return std::visit(
      [&](const auto& kind) {
        return MappedTexel{target_alpha(kind, alpha, specular), target_specular(kind, alpha, specular)};
      },
      mapping);
}

bool is_inside(const Fit& fit, double alpha, double specular) {
  const MappedTexel mapped = evaluate_mapping(fit.mapping, alpha, specular);
  return mapped.alpha < fit.limits.alpha && !(fit.limits.specular && mapped.specular >= *fit.limits.specular);
}

MappedTexel evaluate_fit(const Fit& fit, double alpha, double specular) {
  return grey(rule_of(fit), std::min(alpha, fit.domain.alpha.max), specular);
}

MappedTexel form_texel(const CompactForm& form, const Domain& domain, double alpha, double specular) {
  const MappingKind mapping = form;
  return grey({mapping, domain, limit_of(form.alpha_limit), limit_of(form.specular_limit), form.hinge}, alpha,
              specular);
}

Range own_roughness_range(const Fit& fit) {
  const double a = from_alpha(fit.source.roughness, fit.domain.alpha.min);
  const double b = from_alpha(fit.source.roughness, fit.domain.alpha.max);
  return as_floats({std::min(a, b), std::max(a, b)});
}

Range specular_range(const Fit& fit) { return as_floats(fit.domain.specular); }

double evaluate_texel(const Fit& fit, double roughness, std::span<const double> specular,
                      std::span<double> specular_out, bool* in_domain) {
  const FormEnds ends = ends_of(fit.source.roughness, fit.target.roughness, own_roughness_range(fit));
  const Range covered = specular_range(fit);
  bool inside =
      Range{static_cast<double>(ends.width_min), static_cast<double>(ends.width_max)}.contains(roughness);
  bool is_finite = std::isfinite(roughness);
  for (std::size_t c = 0; c < specular.size(); ++c) {
    inside = inside && covered.contains(specular[c]);
    is_finite = is_finite && std::isfinite(specular[c]);
    specular_out[c] = std::max(specular[c], 0.0);
  }
  if (in_domain != nullptr) *in_domain = inside;
  if (!is_finite) {
    std::ranges::fill(specular_out, std::numeric_limits<double>::quiet_NaN());
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double own =
      std::clamp(roughness, static_cast<double>(ends.width_from), static_cast<double>(ends.width_to));
  const double alpha = std::max(rule_of(fit)(to_alpha(fit.source.roughness, own), specular_out),
                                static_cast<double>(ends.least_alpha));
  return from_alpha(fit.target.roughness, alpha);
}

}  // namespace remap
