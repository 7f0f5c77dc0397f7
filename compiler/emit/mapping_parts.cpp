// Functions that the code of polynomials and the code of curves share.
#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"

namespace remapc {
namespace {

constexpr std::string_view kFunction = R"(
@comment@
@table@
inline float @name@(@parameters@) noexcept {
  @statements@
}
)";

}  // namespace

std::string function_code(const FunctionParts& parts) {
  return fill_template(kFunction, {{"comment", parts.comment},
                                   {"table", parts.table},
                                   {"name", parts.name},
                                   {"parameters", parts.parameters},
                                   {"statements", parts.statements}});
}

std::string terms_code(const TermsParts& parts) {
  const auto row = [](const std::string& name) { return name + "[kBlock]"; };
  const auto store = [](const std::string& name) { return "terms." + name + "[i] = " + name + ";\n"; };
  return "\n" + fill_template(code_file("specular_terms"),
                              {{"comment", parts.comment},
                               {"table", parts.table},
                               {"rows", joined(parts.names, ", ", row)},
                               {"more_rows", parts.more_rows},
                               {"alpha", parts.uses_alpha ? "const float alpha = terms.alpha[i];" : ""},
                               {"statements", parts.statements},
                               {"store", joined(parts.names, "", store)},
                               {"specular", parts.uses_specular ? "float specular" : "float"},
                               {"sum", parts.sum}});
}

std::string horner_code(const std::vector<std::string>& coefficients, const std::string& result,
                        const std::string& variable) {
  std::string text = "float " + result + " = " + coefficients.back() + ";\n";
  for (std::size_t i = coefficients.size() - 1; i-- > 0;)
    text += result + " = " + result + " * " + variable +
            (coefficients[i].empty() ? "" : " + " + coefficients[i]) + ";\n";
  return text;
}

}  // namespace remapc
