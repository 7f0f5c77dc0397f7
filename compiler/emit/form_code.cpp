// This file writes a compact form as C++: its numbers, and functions for one texel.
#include <algorithm>

#include "core/number_text.hpp"
#include "emit/converter_formula.hpp"
#include "emit/header_data.hpp"
#include "formula/text_template.hpp"

namespace remap {
namespace {

std::string float_text(float value) { return literal(static_cast<double>(value)); }

std::string code_of(const Expression& expression) {
  return text_of(expression,
                 {float_literal, calls_by({{"min", "least"}, {"max", "most"}, {"sqrt", "root"}})});
}

bool depends_on_alpha(const FactorTerms& factor) {
  return std::ranges::any_of(factor, [](const auto& row) { return row.size() > 1; });
}

std::string limit_text(const std::optional<float>& limit) {
  return limit ? float_text(*limit) : "std::numeric_limits<float>::infinity()";
}

}  // namespace

std::string form_code(const ConverterData& converter) {
  const CompactForm& form = converter.form;
  const ConverterInfo& info = converter.info;
  const FormEnds ends = ends_of(info.source.roughness, info.target.roughness, info.roughness);
  const std::string to_alpha = code_of(alpha_of(info.source.roughness, "own")),
                    from_alpha = code_of(native_of(info.target.roughness, "alpha"));
  const bool is_limited = form.alpha_limit || form.specular_limit;
  return fill_template(
      code_file("form"),
      {{"width_min", float_text(ends.width_min)},
       {"width_max", float_text(ends.width_max)},
       {"width_from", float_text(ends.width_from)},
       {"width_to", float_text(ends.width_to)},
       {"specular_min", literal(info.specular.min)},
       {"specular_max", literal(info.specular.max)},
       {"held",
        info.specular.min > 0.0 ? "least(most(s, specular_min), specular_max)" : "least(s, specular_max)"},
       {"alpha_min", float_text(ends.alpha_min)},
       {"least_alpha", float_text(ends.least_alpha)},
       {"pole", float_text(form.pole)},
       {"limits", is_limited ? fill_template(code_file("form_limits"),
                                             {{"alpha_limit", limit_text(form.alpha_limit)},
                                              {"specular_limit", limit_text(form.specular_limit)},
                                              {"turn", float_text(form.hinge.turn)},
                                              {"turn_by_alpha", float_text(form.hinge.turn_by_alpha)},
                                              {"bend", float_text(form.hinge.bend)},
                                              {"spread", float_text(form.hinge.spread)}})
                             : ""},
       {"alpha", depends_on_alpha(form.alpha) ? " alpha" : ""},
       {"alpha_t", form.alpha.size() > 1 ? " t" : ""},
       {"specular_alpha", depends_on_alpha(form.specular) ? " alpha" : ""},
       {"specular_t", form.specular.size() > 1 ? " t" : ""},
       {"alpha_factor", code_of(factor_expression(form.alpha, "alpha", "t"))},
       {"specular_factor", code_of(factor_expression(form.specular, "alpha", "t"))},
       {"to_alpha", to_alpha},
       {"from_alpha", from_alpha},
       {"root",
        (to_alpha + from_alpha).find("root(") == std::string::npos ? "" : std::string(code_file("root"))},
       {"rows", std::string(code_file("form_rows")) + "\n" +
                    std::string(code_file(is_limited ? "form_limited" : "form_free"))}});
}

}  // namespace remap
