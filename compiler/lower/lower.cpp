#include "lower/lower.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "lower/form_fit.hpp"
#include "lower/interpreter.hpp"
#include "lower/prove.hpp"

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

// Returns four units in the last place of a float. This covers the rounding of conversions and of a texel's
// scale.
double rounding_of(double value) { return 4.8e-7 * std::fabs(value) + 1e-30; }

// Returns how much the target's own parameter changes if alpha changes by `error`.
double own_error(RoughnessEncoding convention, double own, double error) {
  const double alpha = to_alpha(convention, own);
  const double low = from_alpha(convention, std::max(alpha - error, 0.5 * alpha));
  const double high = from_alpha(convention, alpha + error);
  return std::max(std::fabs(low - own), std::fabs(high - own)) + rounding_of(std::fabs(own) + 1.0);
}

// Returns the number as a short decimal.
float bound(double value) { return static_cast<float>(rounded_up(rounded_to_float(value), 2)); }

std::optional<double> two_digits(bool is_known, double error) {
  return is_known ? std::optional<double>(rounded_up(error, 2)) : std::nullopt;
}

std::optional<double> three_digits(const std::optional<double>& value) {
  return value ? std::optional<double>(rounded(*value, 3)) : std::nullopt;
}

std::optional<PictureDifference> picture_difference(const Fit& fit) {
  if (!fit.pictures) return std::nullopt;
  const auto one_decimal = [](double percent) { return std::round(10.0 * percent) / 10.0; };
  return PictureDifference{one_decimal(fit.pictures->rmse), one_decimal(fit.copied_pictures->rmse)};
}

// Returns golden texels. The errors are bounds of target alpha and, within the domain, of target specular.
std::vector<GoldenTexel> golden_texels(const Fit& fit, double alpha_error, double specular_error) {
  const Range own = own_roughness_range(fit), specular = specular_range(fit);
  std::vector<GoldenTexel> texels;
  const auto add = [&](double roughness, double reflectance) {
    const float r = static_cast<float>(roughness), s = static_cast<float>(reflectance);
    const double in = static_cast<double>(s);
    double out = 0.0;
    const double width = evaluate_texel(fit, static_cast<double>(r), {&in, 1}, {&out, 1});
    // beyond the edge, factors are constant
    const double scale = std::max(1.0, in / specular.max);
    texels.push_back({r, s, static_cast<float>(width), static_cast<float>(out),
                      bound(own_error(fit.target.roughness, width, alpha_error)),
                      bound(scale * specular_error + rounding_of(out))});
  };
  constexpr int kWidths = 9;
  for (int i = 0; i < kWidths; ++i) {
    const double share = static_cast<double>(i) / (kWidths - 1);
    add(own.min + share * (own.max - own.min), specular.max * (1.0 - 0.5 * share));
  }
  add(0.5 * own.min, 0.5 * specular.max);
  add(1.5 * own.max, 0.25 * specular.max);
  add(0.5 * (own.min + own.max), 0.0);
  add(0.5 * (own.min + own.max), 2.0 * specular.max);
  return texels;
}

ConverterInfo info_of(const Fit& fit, const CompactForm& form) {
  const bool has_pictures = fit.image_error.has_value();
  return {fit.id,
          fit.source,
          fit.target,
          own_roughness_range(fit),
          specular_range(fit),
          two_digits(fit.follows_rows(), fit.alpha_error.rms),
          two_digits(fit.follows_rows(), fit.specular_error.rms),
          two_digits(has_pictures, has_pictures ? fit.image_error->rms : 0.0),
          three_digits(mean_ssim(fit)),
          picture_difference(fit),
          is_copy(form),
          InstructionSet::kBaseline,
          {}};
}

}  // namespace

ConverterData lower(const Fit& fit, double tolerance) {
  if (const auto* form = std::get_if<CompactForm>(&fit.mapping)) {
    const MappedTexel rounding = rounding_of(*form, fit.domain);
    return {{}, *form, rounding.alpha, rounding.specular, {}};
  }
  if (!is_proportional(fit.mapping) && fit.domain.specular.min <= 0.0)
    throw numeric_error(fit.id +
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
  throw numeric_error(fit.id + ": no form of up to " + std::to_string(kMostLoweredPowers) + " x " +
                      std::to_string(kMostLoweredTerms) + " terms is proven within " +
                      two_figures(kLoosest * alpha_within) + " in alpha and " +
                      two_figures(kLoosest * tolerance) + " of the largest specular");
}

void add_converter(Fit* fit, double tolerance) {
  ConverterData converter = lower(*fit, tolerance);
  converter.info = info_of(*fit, converter.form);
  converter.golden = golden_texels(*fit, converter.alpha_bound, converter.specular_bound);
  // Texels beyond the domain may reach a limit that no texel inside it reaches.
  const auto reaches_limit = [&](const GoldenTexel& texel) {
    return fit->limits.specular && texel.specular_out >= static_cast<float>(*fit->limits.specular);
  };
  if (std::ranges::any_of(converter.golden, reaches_limit))
    converter.form.specular_limit = static_cast<float>(*fit->limits.specular);
  fit->converter = std::move(converter);
}

}  // namespace remap
