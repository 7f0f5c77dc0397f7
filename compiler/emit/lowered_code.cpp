// Polynomials on few pieces as C++.
#include <algorithm>
#include <cmath>

#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"
#include "lower/emitted_order.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::LoweredFunction;
using remap::PiecewisePolynomial;

std::string float_text(float value) { return remap::float_literal(value); }

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
    text += "const float t = alpha / (alpha + " + float_text(polynomial.pole) + ");\n";
  const bool splits = std::any_of(polynomial.degrees.begin(), polynomial.degrees.end(),
                                  [](int degree) { return degree >= remap::kShortestSplit; });
  const std::string square = splits ? "const float u_2 = u * u;\n" : "";
  if (polynomial.cell_count == 1)
    return text + "const float u = " + t + " - " + float_text(polynomial.start) + ";\n" + square;
  text += "const float x = " + t + " * " + float_text(polynomial.scale) + " - " +
          float_text(polynomial.start) + ";\n";
  return text + "const std::int32_t cell = cell_of(x, " + std::to_string(polynomial.cell_count - 1) +
         ");\nconst float u = x - (static_cast<float>(cell) + 0.5f);\nconst float* row = " + table +
         "[cell];\n" + square;
}

// c_power: from literals, or from the row of a table.
std::string horner(const PiecewisePolynomial& polynomial, std::size_t power) {
  std::size_t first = 0;
  for (std::size_t p = 0; p < power; ++p) first += static_cast<std::size_t>(polynomial.degrees[p] + 1);
  const auto number = [&](int i) {
    const std::size_t index = first + static_cast<std::size_t>(i);
    return polynomial.cell_count == 1 ? float_text(polynomial.coefficients[index])
                                      : "row[" + std::to_string(index) + "]";
  };
  const std::string name = "c" + std::to_string(power);
  const int degree = polynomial.degrees[power];
  if (degree < 0) return "const float " + name + " = 0.0f;\n";
  if (degree == 0) return "const float " + name + " = " + number(0) + ";\n";
  std::string text = "float " + name + " = " + number(degree) + ";\n";
  const auto times_plus = [&](const std::string& sum, const std::string& x, const std::string& more) {
    text += sum + " = " + sum + " * " + x + " + " + more + ";\n";
  };
  if (degree < remap::kShortestSplit) {
    for (int i = degree - 1; i >= 0; --i) times_plus(name, "u", number(i));
    return text;
  }
  const std::string next = name + "_next";  // the powers between
  text += "float " + next + " = " + number(degree - 1) + ";\n";
  for (int i = degree - 2; i >= 0; --i) times_plus((degree - i) % 2 == 0 ? name : next, "u_2", number(i));
  if (degree % 2 == 0)
    text += name + " = " + next + " * u + " + name + ";\n";
  else
    times_plus(name, "u", next);
  return text;
}

// The sum over powers of specular, the coefficients being named `prefix`c0`suffix` and so on.
std::string sum_over_powers(const PiecewisePolynomial& polynomial, const std::string& prefix = "",
                            const std::string& suffix = "") {
  const auto name = [&](std::size_t power) { return prefix + "c" + std::to_string(power) + suffix; };
  const std::size_t last = polynomial.degrees.size() - 1;
  if (last == 0) return "return " + name(0) + ";\n";
  std::string text, w = "specular";
  if (polynomial.middle != 0.0f) {
    text += "const float w = specular - " + float_text(polynomial.middle) + ";\n";
    w = "w";
  }
  text += "float sum = " + name(last) + ";\n";
  for (std::size_t p = last; p-- > 0;) text += "sum = sum * " + w + " + " + name(p) + ";\n";
  return text + "return sum;\n";
}

std::string table_text(const PiecewisePolynomial& polynomial, const std::string& name) {
  if (polynomial.cell_count == 1) return "";
  const std::size_t width = polynomial.coefficients_a_cell();
  std::string text = "inline constexpr float " + name + "[" + std::to_string(polynomial.cell_count) + "][" +
                     std::to_string(width) + "] = {\n";
  for (std::size_t i = 0; i < polynomial.coefficients.size(); ++i) {
    if (i % width == 0) text += "    {";
    text += float_text(polynomial.coefficients[i]);
    text += (i + 1) % width == 0 ? "},\n" : ", ";
  }
  return text + "};\n";
}

constexpr std::string_view kCellOf = R"(
// x rounded down, held in [0, last]. Masks in place of comparisons: compilers would branch on them.
inline std::int32_t cell_of(float x, std::int32_t last) noexcept {
  const std::int32_t cell = static_cast<std::int32_t>(x);
  const std::int32_t below = (cell & ~(cell >> 31)) - last;
  return last + (below & (below >> 31));
}
)";

constexpr std::string_view kAlphaAlone = R"(
@table@
inline float target_alpha(@alpha@) noexcept {
  @variable@
  @coefficients@
  return c0;
}
)";

constexpr std::string_view kAlphaBySpecular = R"(
@table@
inline float target_alpha(@alpha@, float specular) noexcept {
  @variable@
  @coefficients@
  @sum@
}
)";

constexpr std::string_view kSlope = R"(
// The factor between the specular parameters.
@table@
inline float specular_slope(@alpha@) noexcept {
  @variable@
  @coefficients@
  return c1;
}
)";

constexpr std::string_view kTerms = R"(
// Target specular is a polynomial in the source's specular; its coefficients are polynomials of alpha, the same for all
// channels: one row of a block for each power.
struct Terms {
  float alpha[kBlock], @rows@;
};

@table@
template <class Count>
inline void specular_terms(Count count, Terms& terms) noexcept {
  const std::size_t size = count;
  @independent@
  for (std::size_t i = 0; i < size; ++i) {
    @alpha@
    @variable@
    @coefficients@
    @store@
  }
}

inline float target_specular(const Terms& terms, std::size_t i, @specular@) noexcept {
  @sum@
}
)";

std::string all_coefficients(const PiecewisePolynomial& polynomial, std::size_t from) {
  std::string text;
  for (std::size_t p = from; p < polynomial.degrees.size(); ++p) text += horner(polynomial, p);
  return text;
}

std::string shape_text(const LoweredFunction& function) {
  const PiecewisePolynomial& polynomial = function.polynomial;
  const auto digits = [](double value) { return remap::number_text(remap::rounded_up(value, 2)); };
  int degree = 0;
  for (const int d : polynomial.degrees) degree = std::max(degree, d);
  std::string text = "degree " + std::to_string(degree);
  if (polynomial.cell_count > 1) text += " on " + std::to_string(polynomial.cell_count) + " pieces";
  if (polynomial.pole != 0.0f)
    text += " in alpha / (alpha + " + remap::number_text(remap::decimal_value(polynomial.pole)) + ")";
  if (polynomial.degrees.size() > 2)
    text += ", " + std::to_string(polynomial.degrees.size() - 1) + " in specular";
  text += ", proven within " + digits(function.bound) + " (sampled " + digits(function.sampled) + ")";
  if (function.rises_with_alpha) text += ", rising with alpha";
  if (function.rises_with_specular) text += ", rising with specular";
  return text;
}

}  // namespace

MappingCode lowered_code(const remap::Lowered& lowered) {
  const PiecewisePolynomial& alpha = lowered.alpha.polynomial;
  const PiecewisePolynomial& specular = lowered.specular.polynomial;
  const bool proportional = specular.degrees.size() == 2 && specular.degrees[0] < 0;
  MappingCode code;
  code.form = proportional && alpha.degrees.size() == 1 ? CodeForm::kProportional : CodeForm::kTerms;
  code.description = "Lowered from the fit. Target alpha: " + shape_text(lowered.alpha) +
                     ".\nTarget specular: " + shape_text(lowered.specular) + ".";
  code.is_positive = lowered.specular.rises_with_specular;
  code.alpha_error = lowered.alpha.bound;
  code.specular_error = lowered.specular.bound;
  if (alpha.cell_count > 1 || specular.cell_count > 1) code.functions += kCellOf;
  const bool alone = code.form == CodeForm::kProportional;
  const std::string alpha_table = table_text(alpha, "kAlphaTable");
  const auto parameter = [](const PiecewisePolynomial& polynomial) {
    return std::string(depends_on_alpha(polynomial) ? "float alpha" : "float");
  };
  std::map<std::string, std::string> holes = {{"alpha", parameter(alpha)},
                                              {"table", alpha_table},
                                              {"variable", variable(alpha, "kAlphaTable")},
                                              {"coefficients", all_coefficients(alpha, 0)}};
  if (!alone) holes["sum"] = sum_over_powers(alpha);
  std::string alpha_code = fill_template(alone ? kAlphaAlone : kAlphaBySpecular, holes);
  if (!alone && alpha.degrees.size() == 1) {  // the same for every specular
    const std::string named = "float specular) noexcept";
    alpha_code.replace(alpha_code.find(named), named.size(), "float) noexcept");
  }
  code.functions += alpha_code;
  if (alone) {
    code.functions += fill_template(kSlope, {{"alpha", parameter(specular)},
                                             {"table", table_text(specular, "kSpecularTable")},
                                             {"variable", variable(specular, "kSpecularTable")},
                                             {"coefficients", all_coefficients(specular, 1)}});
    return code;
  }
  std::string rows, store;
  for (std::size_t p = 0; p < specular.degrees.size(); ++p) {
    const std::string name = "c" + std::to_string(p);
    rows += (p == 0 ? "" : ", ") + name + "[kBlock]";
    store += "terms." + name + "[i] = " + name + ";\n";
  }
  code.functions += fill_template(
      kTerms, {{"rows", rows},
               {"store", store},
               {"independent", std::string(kIndependentLoop)},
               {"alpha", depends_on_alpha(specular) ? "const float alpha = terms.alpha[i];" : ""},
               {"table", table_text(specular, "kSpecularTable")},
               {"variable", variable(specular, "kSpecularTable")},
               {"coefficients", all_coefficients(specular, 0)},
               {"specular", specular.degrees.size() > 1 ? "float specular" : "float"},
               {"sum", sum_over_powers(specular, "terms.", "[i]")}});
  return code;
}

}  // namespace remapc
