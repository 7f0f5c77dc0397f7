// Polynomials on few pieces as C++.
#include <algorithm>

#include "converter/emitted_order.hpp"
#include "core/number_text.hpp"
#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"

namespace remap {
namespace {

constexpr std::string_view kFunction = R"(
@comment@
@table@
[[gnu::always_inline]] inline float @name@(@parameters@) noexcept {
  @statements@
}
)";

// A function of floats, without which a loop that calls it is no vector. Its statements end with a return.
struct FunctionParts {
  std::string comment, table;  // before it; empty for none
  std::string name;
  std::string parameters;
  std::string statements;
};

std::string function_code(const FunctionParts& parts) {
  return fill_template(kFunction, {{"comment", parts.comment},
                                   {"table", parts.table},
                                   {"name", parts.name},
                                   {"parameters", parts.parameters},
                                   {"statements", parts.statements}});
}

// `float RESULT`, a polynomial of `variable` with these coefficients, by Horner's rule from the highest down:
// every product feeds one sum, so that a compiler that fuses, fuses the same in every copy of the loop.
std::string horner_code(const std::vector<std::string>& coefficients, const std::string& result,
                        const std::string& variable) {
  std::string text = "float " + result + " = " + coefficients.back() + ";\n";
  for (std::size_t i = coefficients.size() - 1; i-- > 0;)
    text += result + " = " + result + " * " + variable + " + " + coefficients[i] + ";\n";
  return text;
}

bool depends_on_alpha(const PiecewisePolynomial& polynomial) {
  return polynomial.cell_count > 1 || std::any_of(polynomial.degrees.begin(), polynomial.degrees.end(),
                                                  [](int degree) { return degree > 0; });
}

// The statements that give `u`, and `row` where there is a table.
std::string variable(const PiecewisePolynomial& polynomial, const std::string& table) {
  if (!depends_on_alpha(polynomial)) return "";
  std::string text;
  const std::string t = polynomial.pole == 0.0f ? "alpha" : "t";
  if (polynomial.pole != 0.0f)
    text += "const float t = alpha / (alpha + " + float_literal(polynomial.pole) + ");\n";
  const bool splits = std::any_of(polynomial.degrees.begin(), polynomial.degrees.end(),
                                  [](int degree) { return degree >= kShortestSplit; });
  const std::string square = splits ? "const float u_2 = u * u;\n" : "";
  if (polynomial.cell_count == 1)
    return text + "const float u = " + t + " - " + float_literal(polynomial.start) + ";\n" + square;
  text += "const float x = " + t + " * " + float_literal(polynomial.scale) + " - " +
          float_literal(polynomial.start) + ";\n";
  return text + "const std::int32_t cell = cell_of(x, " + std::to_string(polynomial.cell_count - 1) +
         ");\nconst float u = x - (static_cast<float>(cell) + 0.5f);\nconst float* row = " + table +
         "[cell];\n" + square;
}

// A polynomial of u in the order of in_emitted_order() (converter/emitted_order.hpp).
std::string factor_code(const std::vector<std::string>& coefficients, const std::string& name) {
  if (coefficients.empty()) return "const float " + name + " = 0.0f;\n";
  if (coefficients.size() == 1) return "const float " + name + " = " + coefficients[0] + ";\n";
  const std::size_t degree = coefficients.size() - 1;
  if (degree < static_cast<std::size_t>(kShortestSplit)) return horner_code(coefficients, name, "u");
  const std::string next = name + "_next";  // the sum of every second power
  std::string text = "float " + name + " = " + coefficients[degree] + ";\nfloat " + next + " = " +
                     coefficients[degree - 1] + ";\n";
  for (std::size_t i = degree - 1; i-- > 0;) {
    const std::string& sum = (degree - i) % 2 == 0 ? name : next;
    text += sum + " = " + sum + " * u_2 + " + coefficients[i] + ";\n";
  }
  return text + (degree % 2 == 0 ? name + " = " + next + " * u + " + name + ";\n"
                                 : name + " = " + name + " * u + " + next + ";\n");
}

// c_p for the powers p of specular from `first` on: from literals, or from the row of a table.
std::string factors_code(const PiecewisePolynomial& polynomial, std::size_t first = 0) {
  std::string text;
  std::size_t index = 0;
  for (std::size_t power = 0; power < polynomial.degrees.size(); ++power) {
    std::vector<std::string> coefficients;
    for (int i = 0; i <= polynomial.degrees[power]; ++i, ++index)
      coefficients.push_back(polynomial.cell_count == 1 ? float_literal(polynomial.coefficients[index])
                                                        : "row[" + std::to_string(index) + "]");
    if (power >= first) text += factor_code(coefficients, "c" + std::to_string(power));
  }
  return text;
}

std::vector<std::string> factor_names(const PiecewisePolynomial& polynomial) {
  std::vector<std::string> names;
  for (std::size_t p = 0; p < polynomial.degrees.size(); ++p) names.push_back("c" + std::to_string(p));
  return names;
}

// Statements that return the sum over powers of specular, whose factors have these names.
std::string sum_code(const PiecewisePolynomial& polynomial, const std::vector<std::string>& names) {
  if (names.size() == 1) return "return " + names[0] + ";\n";
  const bool moved = polynomial.middle != 0.0f;
  return (moved ? "const float w = specular - " + float_literal(polynomial.middle) + ";\n" : "") +
         horner_code(names, "sum", moved ? "w" : "specular") + "return sum;\n";
}

std::string cell_table(const PiecewisePolynomial& polynomial, const std::string& name) {
  if (polynomial.cell_count == 1) return "";
  std::vector<std::string> numbers;
  for (const float coefficient : polynomial.coefficients) numbers.push_back(float_literal(coefficient));
  return table_code(name, polynomial.coefficients_a_cell(), numbers);
}

constexpr std::string_view kCellOf = R"(
// x rounded down, clamped to [0, last]. Masks in place of comparisons: compilers would branch on them.
inline std::int32_t cell_of(float x, std::int32_t last) noexcept {
  const std::int32_t cell = static_cast<std::int32_t>(x);
  const std::int32_t below = (cell & ~(cell >> 31)) - last;
  return last + (below & (below >> 31));
}
)";

std::string alpha_parameter(const PiecewisePolynomial& polynomial) {
  return depends_on_alpha(polynomial) ? "float alpha" : "float";
}

// A function of alpha and, unless there is only one power, of specular.
std::string texel_code(const PiecewisePolynomial& polynomial, const std::string& name,
                       const std::string& table, bool takes_specular, const std::string& comment = "") {
  const std::string specular = polynomial.degrees.size() > 1 ? ", float specular" : ", float";
  return function_code({comment, cell_table(polynomial, table), name,
                        alpha_parameter(polynomial) + (takes_specular ? specular : ""),
                        variable(polynomial, table) + factors_code(polynomial) +
                            sum_code(polynomial, factor_names(polynomial))});
}

std::string slope_code(const PiecewisePolynomial& specular) {
  return function_code({"// The factor between the specular parameters.",
                        cell_table(specular, "kSpecularTable"), "specular_slope", alpha_parameter(specular),
                        variable(specular, "kSpecularTable") + factors_code(specular, 1) + "return c1;\n"});
}

// `struct Terms`, specular_terms() and target_specular().
std::string polynomial_terms(const PiecewisePolynomial& specular, CodeForm form) {
  const std::vector<std::string> names = factor_names(specular);
  const auto row = [](const std::string& name) { return name + "[kBlock]"; };
  const auto store = [](const std::string& name) { return "terms." + name + "[i] = " + name + ";\n"; };
  std::vector<std::string> stored;
  for (const std::string& name : names) stored.push_back("terms." + name + "[i]");
  return "\n" + fill_template(
                    code_file("specular_terms"),
                    {{"table", cell_table(specular, "kSpecularTable")},
                     {"rows", joined(names, ", ", row)},
                     {"more_rows", std::string(form == CodeForm::kRegimes ? code_file("regime_rows") : "")},
                     {"alpha", depends_on_alpha(specular) ? "const float alpha = terms.alpha[i];" : ""},
                     {"statements", variable(specular, "kSpecularTable") + factors_code(specular)},
                     {"store", joined(names, "", store)},
                     {"specular", names.size() > 1 ? "float specular" : "float"},
                     {"sum", sum_code(specular, stored)}});
}

}  // namespace

MappingCode mapping_code(const Lowered& lowered) {
  const PiecewisePolynomial& alpha = lowered.alpha.polynomial;
  const PiecewisePolynomial& specular = lowered.specular.polynomial;
  const bool is_factor = specular.degrees.size() == 2 && specular.degrees[0] < 0;
  MappingCode code;
  code.form = lowered.has_limits()                     ? CodeForm::kRegimes
              : is_factor && alpha.degrees.size() == 1 ? CodeForm::kProportional
                                                       : CodeForm::kTerms;
  code.is_positive = lowered.specular.rises_with_specular;
  std::vector<const PiecewisePolynomial*> all = {&alpha, &specular};
  if (lowered.wide) all.push_back(&lowered.wide->specular.function.polynomial);
  if (lowered.bright) all.push_back(&lowered.bright->function.polynomial);
  if (std::ranges::any_of(all, [](const PiecewisePolynomial* one) { return one->cell_count > 1; }))
    code.functions += kCellOf;
  const bool is_proportional = code.form == CodeForm::kProportional;
  code.functions += texel_code(alpha, "target_alpha", "kAlphaTable", !is_proportional) +
                    (is_proportional ? slope_code(specular) : polynomial_terms(specular, code.form));
  if (lowered.wide)
    code.functions += texel_code(lowered.wide->specular.function.polynomial, "wide_specular", "kWideTable",
                                 true, "// Target specular where target alpha is at its limit.");
  if (lowered.bright)
    code.functions += texel_code(lowered.bright->function.polynomial, "bright_alpha", "kBrightTable", true,
                                 "// Target alpha where target specular is at its limit.");
  return code;
}

}  // namespace remap
