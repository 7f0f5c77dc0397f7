// The parametric kind as it was fitted: polynomials for the width, exponentials for the specular.
#include <algorithm>
#include <cmath>
#include <set>

#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"

namespace remapc {
namespace {

using remap::AlphaCurve;
using remap::Parametric;

// Below this product of rate and range an exponential is written as its series: 1 - exp(-x) would cancel.
constexpr double kSeriesLimit = 0.5;

// Horner form from the highest coefficient down: every product feeds one sum, so that a compiler that fuses,
// fuses the same in every copy of the loop.
std::string horner(const std::vector<double>& coefficients, const std::string& result,
                   const std::string& variable) {
  std::string text = "float " + result + " = " + literal(coefficients.back()) + ";\n";
  for (std::size_t i = coefficients.size() - 1; i-- > 0;)
    text += result + " = " + result + " * " + variable + " + " + literal(coefficients[i]) + ";\n";
  return text;
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

constexpr std::string_view kSmaller = R"(
// The smaller of two numbers that are not negative: as integers, which every compiler vectorises.
inline float smaller(float a, float b) noexcept {
  const std::int32_t i = static_cast<std::int32_t>(bits(a)), j = static_cast<std::int32_t>(bits(b));
  return float_from_bits(static_cast<std::uint32_t>(i < j ? i : j));
}
)";

// factor * phi(rate, x) as a sum's term, and the statements it needs. `largest`: of x on the domain.
struct RiseTerm {
  std::string statements;
  std::string expression;  // with a leading " + ", or empty
};

RiseTerm rise_term(const std::string& name, double factor, double rate, const std::string& x,
                   double largest) {
  if (factor == 0.0) return {};
  if (rate * largest <= kSeriesLimit) {
    // phi = x - rate x^2 / 2 + rate^2 x^3 / 6 - ...; eight terms leave 1e-8 of the first.
    std::vector<double> coefficients = {0.0};
    double coefficient = factor;
    for (int i = 1; i <= 8; ++i) {
      coefficients.push_back(coefficient);
      coefficient *= -rate / (i + 1);
    }
    return {horner(coefficients, name, x), " + " + name};
  }
  // Past 87 an exponential is below the smallest float; rates are held there by scaling x at its largest.
  const std::string argument = literal(rate) + " * " + x;
  const std::string bounded = rate * largest <= 87.0 ? argument : "smaller(" + argument + ", 87.0f)";
  return {
      "const float " + name + " = " + literal(factor / rate) + " * (1.0f - exp_of_minus(" + bounded + "));\n",
      " + " + name};
}

std::string curve_code(const AlphaCurve& curve, const std::string& name, double largest) {
  const RiseTerm ramp = rise_term(name + "_ramp", curve.ramp, curve.ramp_rate, "alpha", largest);
  const RiseTerm bump = rise_term(name + "_bump", curve.bump, curve.bump_rate, "alpha_2", largest * largest);
  const std::string pole = curve.pole == 0.0 ? "" : " + " + literal(curve.pole) + " / alpha";
  return ramp.statements + bump.statements + "const float " + name + " = " + literal(curve.start) +
         ramp.expression + bump.expression + pole + ";\n";
}

// Target alpha: rows of a polynomial in alpha, one a power of specular.
std::string alpha_statements(const Parametric& form) {
  std::string text;
  for (std::size_t j = 0; j < form.alpha.size(); ++j) {
    std::vector<double> row = form.alpha[j];
    row.insert(row.begin(), 0.0);
    text += horner(row, "r" + std::to_string(j), "alpha");
  }
  const std::size_t last = form.alpha.size() - 1;
  text += "float sum = r" + std::to_string(last) + ";\n";
  for (std::size_t j = last; j-- > 0;) text += "sum = sum * specular + r" + std::to_string(j) + ";\n";
  return text;
}

constexpr std::string_view kCode = R"(
inline float target_alpha(@parameters@) noexcept {
  @alpha@
  return sum;
}

// Factors of the powers of the source's specular, the same for all channels: one row of a block for each.
struct Terms {
  float alpha[kBlock], @rows@;
};

template <class Count>
inline void specular_terms(Count count, Terms& terms) noexcept {
  const std::size_t size = count;
  @independent@
  for (std::size_t i = 0; i < size; ++i) {
    @read_alpha@
    @square@
    @curves@
    @store@
  }
}

inline float target_specular(const Terms& terms, std::size_t i, @specular@) noexcept {
  @sum@
  return sum;
}
)";

constexpr std::string_view kProportionalCode = R"(
inline float target_alpha(float alpha) noexcept {
  @alpha@
  return sum;
}

// The factor between the specular parameters.
inline float specular_slope(@slope_parameter@) noexcept {
  @square@
  @curves@
  return k1;
}
)";

std::set<int> powers_of(const Parametric& form) {
  std::set<int> powers;
  for (const remap::SpecularTerm& term : form.specular) powers.insert(term.power);
  return powers;
}

// `k1` and so on, the factor of each power: terms of one power add up.
std::string curves_code(const Parametric& form, double largest) {
  std::string text;
  for (const int power : powers_of(form)) {
    const std::string name = "k" + std::to_string(power);
    std::vector<std::string> parts;
    for (const remap::SpecularTerm& term : form.specular) {
      if (term.power != power) continue;
      parts.push_back(name + static_cast<char>('a' + parts.size()));
      text += curve_code(term.factor, parts.back(), largest);
    }
    text += "const float " + name + " = ";
    for (const std::string& part : parts) text += (&part == &parts.front() ? "" : " + ") + part;
    text += ";\n";
  }
  return text;
}

// The sum over the powers that there are, by Horner's rule.
std::string sum_statements(const Parametric& form) {
  const std::set<int> powers = powers_of(form);
  const int last = *powers.rbegin();
  std::string text = "float sum = terms.k" + std::to_string(last) + "[i];\n";
  for (int power = last - 1; power >= 0; --power)
    text += powers.count(power) != 0 ? "sum = sum * specular + terms.k" + std::to_string(power) + "[i];\n"
                                     : "sum = sum * specular;\n";
  return text;
}

constexpr double kUnit = 6e-8;  // above the unit roundoff of a float

// What float arithmetic leaves of Horner's rule (Higham 2002, section 5.1), literals rounded too.
double alpha_error(const Parametric& form, const remap::Domain& domain) {
  double error = 0.0;
  for (std::size_t j = 0; j < form.alpha.size(); ++j)
    for (std::size_t i = 0; i < form.alpha[j].size(); ++i) {
      const auto alpha_power = static_cast<double>(i + 1), specular_power = static_cast<double>(j);
      error += kUnit * (2.0 * alpha_power + 2.0 * specular_power + 4.0) * std::fabs(form.alpha[j][i]) *
               std::pow(domain.alpha.max, alpha_power) * std::pow(domain.specular.max, specular_power);
    }
  return error;
}

// The same for curves: a rise is a series of eight terms, or 1 less an exponential of 2e-7, that is, within
// ten roundings of what it is at most; four more for the sum of a curve, four for every power of specular.
double specular_error(const Parametric& form, const remap::Domain& domain) {
  double error = 0.0;
  for (const remap::SpecularTerm& term : form.specular) {
    const AlphaCurve& curve = term.factor;
    const auto risen = [](double factor, double rate, double largest) {
      return std::fabs(factor) * (rate * largest <= kSeriesLimit ? 2.0 * largest : 1.0 / rate);
    };
    const double magnitude = std::fabs(curve.start) + risen(curve.ramp, curve.ramp_rate, domain.alpha.max) +
                             risen(curve.bump, curve.bump_rate, domain.alpha.max * domain.alpha.max) +
                             (curve.pole == 0.0 ? 0.0 : std::fabs(curve.pole) / domain.alpha.min);
    error += kUnit * (14.0 + 4.0 * term.power) * magnitude * std::pow(domain.specular.max, term.power);
  }
  return error;
}

}  // namespace

MappingCode exact_code(const Parametric& form, const remap::Domain& domain) {
  MappingCode code;
  const bool alone = form.alpha.size() == 1;
  code.form = remap::is_proportional(form) && alone ? CodeForm::kProportional : CodeForm::kTerms;
  code.description = "As fitted: polynomials and exponentials, by an exponential of its own (2e-7).";
  const std::string curves = curves_code(form, domain.alpha.max);
  std::string rows, store;
  for (const int power : powers_of(form)) {
    const std::string name = "k" + std::to_string(power);
    rows += (rows.empty() ? "" : ", ") + name + "[kBlock]";
    store += "terms." + name + "[i] = " + name + ";\n";
  }
  code.alpha_error = alpha_error(form, domain);
  code.specular_error = specular_error(form, domain);
  const std::string square =
      curves.find("alpha_2") != std::string::npos ? "const float alpha_2 = alpha * alpha;" : "";
  std::map<std::string, std::string> holes = {
      {"alpha", alpha_statements(form)}, {"square", square}, {"curves", curves}};
  // A factor may be constant.
  const bool uses_alpha = curves.find("alpha") != std::string::npos;
  if (code.form == CodeForm::kProportional) holes["slope_parameter"] = uses_alpha ? "float alpha" : "float";
  if (code.form == CodeForm::kTerms) {
    holes["specular"] = *powers_of(form).rbegin() > 0 ? "float specular" : "float";
    holes["read_alpha"] = uses_alpha ? "const float alpha = terms.alpha[i];" : "";
    holes["rows"] = rows;
    holes["store"] = store;
    holes["independent"] = std::string(kIndependentLoop);
    holes["sum"] = sum_statements(form);
    holes["parameters"] = alone ? "float alpha, float" : "float alpha, float specular";
  }
  const std::string body = fill_template(code.form == CodeForm::kTerms ? kCode : kProportionalCode, holes);
  if (body.find("smaller(") != std::string::npos) code.functions += kSmaller;
  if (body.find("exp_of_minus(") != std::string::npos) code.functions += kExponential;
  code.functions += body;
  return code;
}

}  // namespace remapc
