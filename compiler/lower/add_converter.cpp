#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"
#include "lower/interpreter.hpp"
#include "lower/lower.hpp"

namespace remap {
namespace {

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
