// A compact form as C++: its numbers, and functions of one texel.
#include <cmath>

#include "emit/convention_text.hpp"
#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"

namespace remap {
namespace {

std::string float_text(float value) { return literal(static_cast<double>(value)); }

// c0 + c1 x + ... by Horner's rule, as `(c1) * x + c0`.
std::string horner(const std::vector<float>& terms) {
  std::string text = float_text(terms.back());
  for (std::size_t i = terms.size() - 1; i-- > 0;)
    text = (i + 2 == terms.size() ? text : "(" + text + ")") + " * alpha + " + float_text(terms[i]);
  return text;
}

// One statement for each power of t.
std::string factor_code(const FactorTerms& factor) {
  std::string text;
  for (std::size_t j = 0; j < factor.size(); ++j)
    text += "c[" + std::to_string(j) + "] = " + horner(factor[j]) + ";\n";
  return text;
}

bool depends_on_alpha(const FactorTerms& factor) {
  for (const std::vector<float>& row : factor)
    if (row.size() > 1) return true;
  return false;
}

std::string limit_text(const std::optional<float>& limit) {
  return limit ? float_text(*limit) : "std::numeric_limits<float>::infinity()";
}
std::string inverse_text(const std::optional<float>& limit) {
  return float_text(limit ? 1.0f / *limit : 0.0f);
}

// Statements over a row whose elements are `own` or `alpha`.
std::string row_loop(const std::string& name, const std::string& expression) {
  if (expression == name) return "";
  return "for (float& " + name + " : row) " + name + " = " + expression + ";\n";
}

}  // namespace

std::string form_code(const ConverterData& converter) {
  const CompactForm& form = converter.form;
  const ConverterInfo& info = converter.info;
  const FormEnds ends = ends_of(info.source.roughness, info.target.roughness, info.roughness);
  const ConventionText source = convention_text(info.source.roughness),
                       target = convention_text(info.target.roughness);
  const std::string roots = "take_roots(row);\n";
  const bool is_limited = form.alpha_limit || form.specular_limit;
  const std::string to_alpha = row_loop("own", source.to_alpha) + (source.alpha_is_root ? roots : "");
  const std::string from_alpha = (target.takes_root ? roots : "") + row_loop("alpha", target.from_alpha);
  return fill_template(
      code_file("form"),
      {{"width_min", float_text(ends.width_min)},
       {"width_max", float_text(ends.width_max)},
       {"width_from", float_text(ends.width_from)},
       {"width_to", float_text(ends.width_to)},
       {"specular_min", literal(info.specular.min)},
       {"specular_max", literal(info.specular.max)},
       {"alpha_min", float_text(ends.alpha_min)},
       {"least_alpha", float_text(ends.least_alpha)},
       {"pole", float_text(form.pole)},
       {"is_limited", is_limited ? "true" : "false"},
       {"limits", is_limited ? fill_template(code_file("form_limits"),
                                             {{"alpha_limit", limit_text(form.alpha_limit)},
                                              {"specular_limit", limit_text(form.specular_limit)},
                                              {"inverse_alpha_limit", inverse_text(form.alpha_limit)},
                                              {"inverse_specular_limit", inverse_text(form.specular_limit)},
                                              {"turn", float_text(form.hinge.turn)},
                                              {"turn_by_alpha", float_text(form.hinge.turn_by_alpha)},
                                              {"bend", float_text(form.hinge.bend)},
                                              {"spread", float_text(form.hinge.spread)}})
                             : ""},
       {"alpha_powers", std::to_string(form.alpha.size())},
       {"specular_powers", std::to_string(form.specular.size())},
       {"alpha_of_alpha", depends_on_alpha(form.alpha) ? "float alpha" : "float"},
       {"specular_of_alpha", depends_on_alpha(form.specular) ? "float alpha" : "float"},
       {"alpha_factor", factor_code(form.alpha)},
       {"specular_factor", factor_code(form.specular)},
       {"to_alpha", to_alpha},
       {"to_row", to_alpha.empty() ? "" : "row"},
       {"from_alpha", from_alpha},
       {"from_row", from_alpha.empty() ? "" : "row"}});
}

}  // namespace remap
