#include "lower/lower.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/number_text.hpp"
#include "lower/form_fit.hpp"
#include "lower/interpreter.hpp"
#include "lower/prove.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

constexpr int kSampledAlphas = 48, kSampledSpeculars = 24;  // numbers of samples to which a form is fitted
constexpr std::size_t kMostLoweredPowers = 8, kMostLoweredTerms = 12;
constexpr double kLoosest = 10.0;     // loosest bound that is accepted, as a multiple of the tolerances
constexpr std::size_t kBoxes = 6000;  // a proof examines at most so many boxes, which takes about a second

// Returns the shapes, the smallest first. A mapping that does not depend on t needs only one power.
std::vector<FormShape> lowering_shapes(const MappingKind& mapping) {
  std::vector<FormShape> shapes;
  const bool has_t = alpha_depends_on_specular(mapping) || !is_proportional(mapping);
  for (std::size_t terms = 1; terms <= kMostLoweredTerms; ++terms)
    for (std::size_t powers = 1; powers <= std::min(has_t ? kMostLoweredPowers : 1, terms); ++powers)
      if (powers == 1 || 2 * powers + 4 >= terms) shapes.push_back({powers, terms});
  return shapes;
}

// Returns samples that are closer together where alpha is small, because curves bend most there.
std::vector<FormSample> samples_of(const Fit& fit) {
  std::vector<FormSample> samples;
  const Domain& domain = fit.domain;
  for (int i = 0; i <= kSampledAlphas; ++i)
    for (int j = 0; j <= kSampledSpeculars; ++j) {
      const double share = static_cast<double>(i) / kSampledAlphas,
                   part = static_cast<double>(j) / kSampledSpeculars;
      const double alpha = domain.alpha.min + (domain.alpha.max - domain.alpha.min) * share * share;
      const double specular = domain.specular.min + (domain.specular.max - domain.specular.min) * part * part;
      samples.push_back({{alpha, specular}, evaluate_mapping(fit.mapping, alpha, specular), false, false});
    }
  return samples;
}

MappedTexel sampled_distance(const CompactForm& form, const std::vector<FormSample>& samples) {
  MappedTexel most;
  for (const FormSample& sample : samples) {
    const MappedTexel found = evaluate_mapping(form, sample.source.alpha, sample.source.specular);
    most.alpha = std::max(most.alpha, std::fabs(found.alpha - sample.target.alpha));
    most.specular = std::max(most.specular, std::fabs(found.specular - sample.target.specular));
  }
  return most;
}

std::string two_figures(double value) { return number_text(rounded_up(value, 2)); }

CompactForm limited(CompactForm form, const Fit& fit, const std::vector<FormSample>& samples) {
  const auto passes = [&](double MappedTexel::*part, double limit) {
    return std::ranges::any_of(samples, [&](const FormSample& s) { return s.target.*part > limit; });
  };
  if (passes(&MappedTexel::alpha, fit.limits.alpha)) form.alpha_limit = static_cast<float>(fit.limits.alpha);
  if (fit.limits.specular && passes(&MappedTexel::specular, *fit.limits.specular))
    form.specular_limit = static_cast<float>(*fit.limits.specular);
  return form;
}

double largest(const std::vector<FormSample>& samples, const std::optional<double>& limit) {
  double most = 0.0;
  for (const FormSample& sample : samples) most = std::max(most, std::fabs(sample.target.specular));
  return std::min(most, limit.value_or(most));
}

}  // namespace

ConverterData lower(const Fit& fit, double tolerance) {
  if (const auto* form = std::get_if<CompactForm>(&fit.mapping)) {
    const MappedTexel rounding = rounding_of(*form, fit.domain);
    return {{}, *form, rounding.alpha, rounding.specular, {}};
  }
  if (!is_proportional(fit.mapping) && fit.domain.specular.min <= 0.0)
    throw Error(ErrorKind::kNumeric,
                fit.id +
                    ": target specular is above 0 where source specular is 0, so the domain of the fit "
                    "must begin above specular 0");
  const std::vector<FormSample> samples = samples_of(fit);
  const double unit = largest(samples, fit.limits.specular);
  const double alpha_within = tolerance, specular_within = tolerance * unit;
  ConverterData best;
  double nearest = INFINITY, proven = INFINITY;  // both are relative to the tolerances
  for (const FormShape& shape : lowering_shapes(fit.mapping)) {
    const CompactForm form = fit_form(samples, {}, fit.domain, shape);
    const MappedTexel sampled = sampled_distance(form, samples), rounding = rounding_of(form, fit.domain);
    const auto relative = [&](const MappedTexel& distance) {
      return std::max((distance.alpha + rounding.alpha) / alpha_within,
                      (distance.specular + rounding.specular) / specular_within);
    };
    const double least = relative(sampled);
    if (!(least <= std::max(1.0, 0.7 * nearest)) || least >= proven) continue;
    nearest = least;
    const double target = std::clamp(1.3 * least, 1.0, kLoosest);
    const MappedTexel bound = proven_distance(
        fit.mapping, form, fit.domain,
        {target * alpha_within - rounding.alpha, target * specular_within - rounding.specular}, kBoxes);
    if (relative(bound) >= proven) continue;
    proven = relative(bound);
    best.form = limited(form, fit, samples);
    best.alpha_bound = bound.alpha + rounding.alpha;
    best.specular_bound = bound.specular + rounding.specular;
    if (proven <= 1.0) return best;
  }
  if (proven <= kLoosest) return best;
  throw Error(ErrorKind::kNumeric, fit.id + ": no form of up to " + std::to_string(kMostLoweredPowers) +
                                       " x " + std::to_string(kMostLoweredTerms) +
                                       " terms is proven within " + two_figures(kLoosest * alpha_within) +
                                       " in alpha and " + two_figures(kLoosest * tolerance) +
                                       " of the largest specular");
}

}  // namespace remap
