// A fit that was not compiled, at nearly the speed of one that was: lowered once, then rows of floats.
#include <array>
#include <cmath>
#include <utility>

#include "convert/converter.hpp"
#include "convert/lowered_kernel.hpp"
#include "lower/lower.hpp"
#include "model/interpreter.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// What rounding of parameters to floats may add to a proven bound, relative to magnitudes of order one.
constexpr double kRounding = 1e-6;

void require_evaluable(const Fit& fit, const Lowered& lowered) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorKind::kNumeric, "lower: " + what); };
  for (const LoweredFunction* function : {&lowered.alpha, &lowered.specular})
    if (function->polynomial.degrees.size() > kMostPowers)
      refuse("the degree in specular is " + std::to_string(function->polynomial.degrees.size() - 1) +
             "; expected " + std::to_string(kMostPowers - 1) + " at most");
  const Range specular = specular_range(fit);
  if (!(specular.min >= 0.0 && specular.max > 0.0 && own_roughness_range(fit).min >= 0.0))
    refuse("the domain is empty or negative; expected specular up to more than 0, and widths from 0");
}

class LoweredConverter final : public Converter {
 public:
  LoweredConverter(Fit fit, const Lowered& lowered, InstructionSet set)
      : Converter(converter_info(fit, set)),
        fit_(std::move(fit)),
        alpha_bound_(lowered.alpha.bound),
        specular_bound_(lowered.specular.bound),
        kernel_(lowered_kernel(set)) {
    const Range own = own_roughness_range(fit_), covered = specular_range(fit_);
    pass_ = {fit_.source.roughness,
             fit_.target.roughness,
             static_cast<float>(own.min),
             static_cast<float>(own.max),
             static_cast<float>(covered.min),
             static_cast<float>(covered.max),
             polynomial_rows(lowered.alpha.polynomial),
             polynomial_rows(lowered.specular.polynomial)};
  }

  std::size_t convert(std::size_t count, const float* roughness, std::span<const float* const> specular,
                      float* roughness_out, std::span<float* const> specular_out) const override {
    if (specular.empty() || specular.size() > 3)
      throw Error(ErrorKind::kUsage, "converter: got " + std::to_string(specular.size()) +
                                         " specular channels; expected 1 to 3");
    return kernel_(pass_, count, roughness, specular, roughness_out, specular_out);
  }

  bool self_test() const override {
    constexpr int kWidths = 41, kSpeculars = 13;
    for (int i = 0; i < kWidths; ++i)
      for (int j = 0; j < kSpeculars; ++j) {
        const float width = static_cast<float>(1.2 * i / (kWidths - 1) - 0.1);
        const float specular = 1.5f * static_cast<float>(j) / (kSpeculars - 1);
        const float roughness = pass_.roughness_min + width * (pass_.roughness_max - pass_.roughness_min);
        if (!agrees_with_interpreter(roughness, specular * pass_.specular_max)) return false;
      }
    return true;
  }

 private:
  bool agrees_with_interpreter(float roughness, float specular) const {
    float width = 0.0f, mapped = 0.0f;
    const std::array<const float*, 1> in = {&specular};
    const std::array<float*, 1> out = {&mapped};
    convert(1, &roughness, in, &width, out);
    const double given = static_cast<double>(specular);
    double expected = 0.0;
    const double expected_width =
        evaluate_texel(fit_, static_cast<double>(roughness), {&given, 1}, {&expected, 1});
    const auto alpha = [&](double own) { return to_alpha(fit_.target.roughness, own); };
    const double alpha_error = std::fabs(alpha(static_cast<double>(width)) - alpha(expected_width));
    const double scale = std::max(1.0, given / specular_range(fit_).max);
    return alpha_error <= alpha_bound_ + kRounding &&
           std::fabs(static_cast<double>(mapped) - expected) <=
               scale * (specular_bound_ + kRounding) + kRounding * std::fabs(expected);
  }

  Fit fit_;
  double alpha_bound_;     // proven, |lowered - fit|
  double specular_bound_;  // the same, within the domain
  LoweredPass pass_;
  LoweredKernel kernel_;
};

}  // namespace

std::unique_ptr<Converter> make_lowered_converter(Fit fit, InstructionSet set) {
  const Lowered lowered = lower(fit.mapping, fit.domain);
  return make_lowered_converter(std::move(fit), lowered, set);
}

std::unique_ptr<Converter> make_lowered_converter(Fit fit, const Lowered& lowered, InstructionSet set) {
  require_evaluable(fit, lowered);
  return std::make_unique<LoweredConverter>(std::move(fit), lowered, set);
}

}  // namespace remap
