// The generated code of the parametric kind: a quartic for the width, a polynomial for the slope where one is
// close enough to its exponentials, else the exponentials.
#include <cmath>

#include "emit/emit.hpp"
#include "emit/slope_polynomial.hpp"
#include "emit/text_template.hpp"
#include "model/interpreter.hpp"
#include "number_text.hpp"

namespace remapc {
namespace {

using remap::float_literal;
using remap::Parametric;

// Together with the rounding of a few float operations this stays within the 1e-6 that self_test() allows.
constexpr double kSlopeTolerance = 2e-7;
// Beyond this two exponentials are no dearer.
constexpr int kMaxDegree = 14;
// Below this rate * width the closed form of phi loses digits to cancellation and the series is used.
constexpr double kSeriesLimit = 0.5;

std::string literal(double value) { return float_literal(static_cast<float>(value)); }

// `((c3 * x + c2) * x + c1) * x + c0` as one statement a step: readable at any degree.
std::string horner(const std::vector<double>& coefficients, const std::string& result,
                   const std::string& variable) {
  std::string text = "float " + result + " = " + literal(coefficients.back()) + ";\n";
  for (std::size_t i = coefficients.size() - 1; i-- > 0;)
    text += result + " = " + result + " * " + variable + " + " + literal(coefficients[i]) + ";\n";
  return text;
}

// The even and the odd powers as two chains of half the length (Estrin 1960, first step): a processor works
// on both at once, where Horner's single chain would wait for itself.
std::string even_odd(const std::vector<double>& coefficients, const std::string& variable) {
  if (coefficients.size() <= 4) return horner(coefficients, "k", variable) + "return k;\n";
  std::vector<double> even, odd;
  for (std::size_t i = 0; i < coefficients.size(); ++i) (i % 2 == 0 ? even : odd).push_back(coefficients[i]);
  const std::string square = variable + "_2";
  return "const float " + square + " = " + variable + " * " + variable + ";\n" +
         horner(even, "even", square) + horner(odd, "odd", square) + "return odd * " + variable +
         " + even;\n";
}

constexpr std::string_view kExponential = R"(
// exp(-x) for 0 <= x <= 87, relative error below 2e-7: 2^n times a polynomial for 2^f, f in [-1/2, 1/2].
inline float exp_of_minus(float x) noexcept {
  const float t = x * -1.44269504f;
  const std::int32_t n = static_cast<std::int32_t>(t - 0.5f);
  const float f = t - static_cast<float>(n);
  float p = 1.5403530e-4f;
  p = p * f + 1.3333558e-3f;
  p = p * f + 9.6181291e-3f;
  p = p * f + 5.5504109e-2f;
  p = p * f + 2.4022651e-1f;
  p = p * f + 6.9314718e-1f;
  p = p * f + 1.0f;
  return float_from_bits(bits(p) + (static_cast<std::uint32_t>(n) << 23));
}
)";

// factor * phi(rate, x) as an expression, and the statements it needs. `largest`: of x on the domain.
struct RiseTerm {
  std::string statements;
  std::string expression;
};

RiseTerm rise_term(const std::string& name, double factor, double rate, const std::string& x,
                   double largest) {
  if (rate * largest <= kSeriesLimit) {
    // phi = x - rate x^2 / 2 + rate^2 x^3 / 6 - ...; eight terms leave 1e-8 of the first.
    std::vector<double> coefficients = {0.0};
    double coefficient = factor;
    for (int i = 1; i <= 8; ++i) {
      coefficients.push_back(coefficient);
      coefficient *= -rate / (i + 1);
    }
    return {horner(coefficients, name, x), name};
  }
  // Past 87 an exponential is below the smallest float; rates are held there by scaling x at its largest.
  const std::string argument = literal(rate) + " * " + x;
  const std::string bounded = rate * largest <= 87.0 ? argument : "smaller(" + argument + ", 87.0f)";
  return {
      "const float " + name + " = " + literal(factor / rate) + " * (1.0f - exp_of_minus(" + bounded + "));\n",
      name};
}

constexpr std::string_view kSmaller = R"(
// The smaller of two numbers that are not negative: as integers, which every compiler vectorises.
inline float smaller(float a, float b) noexcept {
  const std::int32_t i = static_cast<std::int32_t>(bits(a)), j = static_cast<std::int32_t>(bits(b));
  return float_from_bits(static_cast<std::uint32_t>(i < j ? i : j));
}
)";

constexpr std::string_view kWidth = R"(
// Target alpha, Horner form.
inline float target_alpha(float alpha) noexcept {
  return (((@a4@ * alpha + @a3@) * alpha + @a2@) * alpha + @a1@) * alpha;
}
)";

constexpr std::string_view kPolynomialSlope = R"(
// k(alpha), the factor between the specular parameters.
inline float specular_slope(float alpha) noexcept {
  const float u = alpha - @centre@;
  @polynomial@
}
)";

constexpr std::string_view kExponentialSlope = R"(
// k(alpha), the factor between the specular parameters.
inline float specular_slope(float alpha) noexcept {
  const float alpha_2 = alpha * alpha;
  @ramp@
  @bump@
  return @start@ + ramp + bump;
}
)";

}  // namespace

MappingCode mapping_code(const Parametric& form, const remap::Domain& domain) {
  const auto& r = form.roughness;
  std::string functions = fill_template(
      kWidth, {{"a1", literal(r[0])}, {"a2", literal(r[1])}, {"a3", literal(r[2])}, {"a4", literal(r[3])}});
  const double scale = std::fabs(remap::specular_slope(form, domain.alpha.min));
  if (const auto polynomial =
          approximate_slope(form, domain.alpha, kSlopeTolerance * std::fmax(1.0, scale), kMaxDegree)) {
    functions += fill_template(kPolynomialSlope, {{"centre", literal(polynomial->centre)},
                                                  {"polynomial", even_odd(polynomial->coefficients, "u")}});
    const std::string degree = std::to_string(polynomial->coefficients.size() - 1);
    return {"Slope k(alpha): the fit's exponentials as a polynomial of degree " + degree +
                ", proven within " + remap::number_text(remap::rounded_up(polynomial->bound, 2)) +
                " of them.",
            functions};
  }
  const double largest = domain.alpha.max;
  const RiseTerm ramp = rise_term("ramp", form.ramp, form.ramp_rate, "alpha", largest);
  const RiseTerm bump = rise_term("bump", form.bump, form.bump_rate, "alpha_2", largest * largest);
  const std::string slope =
      fill_template(kExponentialSlope,
                    {{"ramp", ramp.statements}, {"bump", bump.statements}, {"start", literal(form.start)}});
  std::string helpers;
  if (slope.find("smaller(") != std::string::npos) helpers += kSmaller;
  if (slope.find("exp_of_minus(") != std::string::npos) helpers += kExponential;
  return {"Slope k(alpha): the fit's exponentials, by an exponential of its own.",
          helpers + functions + slope};
}

}  // namespace remapc
