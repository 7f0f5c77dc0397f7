// The parametric kind as it was fitted: polynomials for the width, exponentials for the specular.
#include <set>

#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"

namespace remapc {
namespace {

using remap::Parametric;

// The exponential of minus a larger argument is below the smallest float.
constexpr double kLargestArgument = 87.0;

std::vector<std::string> literals(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(literal(value));
  return texts;
}

constexpr std::string_view kSmaller = R"(
// The smaller of two numbers that are not negative: as integers, which every compiler vectorises.
inline float smaller(float a, float b) noexcept {
  const std::int32_t i = static_cast<std::int32_t>(bits(a)), j = static_cast<std::int32_t>(bits(b));
  return float_from_bits(static_cast<std::uint32_t>(i < j ? i : j));
}
)";

// factor * phi(rate, x), a term of a curve (model/mapping.hpp).
struct Rise {
  std::string name;  // of the variable
  double factor = 0.0, rate = 0.0;
  std::string x;
  double largest = 0.0;  // of rate x on the domain

  bool is_series() const { return largest <= kSeriesLimit; }
};

// The ramp and the bump of a curve, unless they are 0.
std::vector<Rise> rises_of(const remap::AlphaCurve& curve, const std::string& name, double largest_alpha) {
  std::vector<Rise> rises = {
      {name + "_ramp", curve.ramp, curve.ramp_rate, "alpha", curve.ramp_rate * largest_alpha},
      {name + "_bump", curve.bump, curve.bump_rate, "alpha_2",
       curve.bump_rate * (largest_alpha * largest_alpha)}};
  std::erase_if(rises, [](const Rise& rise) { return rise.factor == 0.0; });
  return rises;
}

std::string rise_code(const Rise& rise) {
  if (rise.is_series()) {
    // phi = x - rate x^2 / 2 + rate^2 x^3 / 6 - ...; eight terms leave 1e-8 of the first.
    std::vector<double> coefficients = {0.0};
    double coefficient = rise.factor;
    for (int i = 1; i <= 8; ++i) {
      coefficients.push_back(coefficient);
      coefficient *= -rise.rate / (i + 1);
    }
    return horner_code(literals(coefficients), rise.name, rise.x);
  }
  const std::string argument = literal(rise.rate) + " * " + rise.x;
  const std::string bounded =
      rise.largest <= kLargestArgument ? argument : "smaller(" + argument + ", 87.0f)";
  return "const float " + rise.name + " = " + literal(rise.factor / rise.rate) + " * (1.0f - exp_of_minus(" +
         bounded + "));\n";
}

std::string curve_code(const remap::AlphaCurve& curve, const std::string& name, double largest_alpha) {
  const std::vector<Rise> rises = rises_of(curve, name, largest_alpha);
  const std::string pole = curve.pole == 0.0 ? "" : " + " + literal(curve.pole) + " / alpha";
  return joined(rises, "", rise_code) + "const float " + name + " = " + literal(curve.start) +
         joined(rises, "", [](const Rise& rise) { return " + " + rise.name; }) + pole + ";\n";
}

// Statements that return target alpha: a polynomial in alpha for each power of specular.
std::string alpha_statements(const Parametric& form) {
  std::string text;
  std::vector<std::string> names;
  for (const std::vector<double>& coefficients : form.roughness) {
    std::vector<double> row = coefficients;
    row.insert(row.begin(), 0.0);
    names.push_back("r" + std::to_string(names.size()));
    text += horner_code(literals(row), names.back(), "alpha");
  }
  return text + horner_code(names, "sum", "specular") + "return sum;\n";
}

std::set<int> powers_of(const Parametric& form) {
  std::set<int> powers;
  for (const remap::SpecularTerm& term : form.specular) powers.insert(term.power);
  return powers;
}

// `k1` and so on, the factor of each power: terms of one power add up.
std::string curves_code(const FittedCurves& curves) {
  std::string text;
  for (const int power : powers_of(curves.form)) {
    const std::string name = "k" + std::to_string(power);
    std::vector<std::string> parts;
    for (const remap::SpecularTerm& term : curves.form.specular) {
      if (term.power != power) continue;
      parts.push_back(name + static_cast<char>('a' + parts.size()));
      text += curve_code(term.factor, parts.back(), curves.largest_alpha);
    }
    text += "const float " + name + " = " +
            joined(parts, " + ", [](const std::string& part) { return part; }) + ";\n";
  }
  return text;
}

// What the statements of the curves use.
struct Uses {
  bool alpha = false, square = false, exponential = false, smaller = false;
};

Uses uses_of(const FittedCurves& curves) {
  Uses uses;
  for (const remap::SpecularTerm& term : curves.form.specular) {
    uses.alpha = uses.alpha || term.factor.pole != 0.0;
    for (const Rise& rise : rises_of(term.factor, "", curves.largest_alpha)) {
      uses.alpha = true;
      uses.square = uses.square || rise.x == "alpha_2";
      uses.exponential = uses.exponential || !rise.is_series();
      uses.smaller = uses.smaller || (!rise.is_series() && rise.largest > kLargestArgument);
    }
  }
  return uses;
}

std::string curve_terms(const Parametric& form, const Uses& uses, const std::string& statements) {
  const std::set<int> powers = powers_of(form);
  const int last = *powers.rbegin();
  TermsParts parts;
  parts.comment =
      "// Factors of the powers of the source's specular, the same for all channels: one row of a block for "
      "each.";
  parts.uses_alpha = uses.alpha;
  parts.statements = statements;
  parts.uses_specular = last > 0;
  std::vector<std::string> stored(static_cast<std::size_t>(last) + 1);  // empty for a power without terms
  for (const int power : powers) {
    parts.names.push_back("k" + std::to_string(power));
    stored[static_cast<std::size_t>(power)] = "terms." + parts.names.back() + "[i]";
  }
  parts.sum = horner_code(stored, "sum", "specular") + "return sum;\n";
  return terms_code(parts);
}

}  // namespace

MappingCode mapping_code(const FittedCurves& curves) {
  const Parametric& form = curves.form;
  const Uses uses = uses_of(curves);
  const bool alone = form.roughness.size() == 1;
  const std::string statements =
      (uses.square ? "const float alpha_2 = alpha * alpha;\n" : "") + curves_code(curves);
  MappingCode code;
  if (uses.smaller) code.functions += kSmaller;
  if (uses.exponential) code.functions += code_files({"exp_of_floats"});
  if (alone && remap::is_proportional(form)) {
    code.form = CodeForm::kProportional;
    code.functions += function_code({"", "", "target_alpha", "float alpha", alpha_statements(form)}) +
                      function_code({"// The factor between the specular parameters.", "", "specular_slope",
                                     uses.alpha ? "float alpha" : "float", statements + "return k1;\n"});
    return code;
  }
  code.form = CodeForm::kTerms;
  code.functions +=
      function_code({"", "", "target_alpha", alone ? "float alpha, float" : "float alpha, float specular",
                     alpha_statements(form)}) +
      curve_terms(form, uses, statements);
  return code;
}

}  // namespace remapc
