// The domain rule as C++: the text of runtime/convert/code, which texremap also runs over vectors of texels,
// with the definitions that this text needs.
#include "emit/convention_text.hpp"
#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"

namespace remapc {
namespace {

// What the rule needs of one converter.
constexpr std::string_view kMapping = R"(
// What is this converter's own: its domain, the conventions of its widths and its functions.
struct Mapping {
  static constexpr Domain domain{kDomainMin.@in_roughness@, kDomainMax.@in_roughness@, kDomainMin.@in_specular@,
                                 kDomainMax.@in_specular@, @inverse_edge@};
  static float alpha_of(float own) noexcept { return @to_alpha@; }
  static float own_of(float alpha) noexcept { return @from_alpha@; }
  @functions@
};
)";

constexpr std::string_view kProportionalFunctions =
    R"(static float target_alpha(float alpha, std::size_t) noexcept { return detail::target_alpha(alpha); }
static float specular_slope(float alpha, std::size_t) noexcept { return @slope@; }
)";

constexpr std::string_view kTermsFunctions =
    R"(static constexpr bool alpha_by_specular = @alpha_by_specular@;  // whether target alpha depends on specular
static float target_alpha(const Terms& terms, std::size_t i, float top) noexcept {
  return detail::target_alpha(terms.alpha[i], top);
}
static float target_specular(const Terms& terms, std::size_t i, float specular) noexcept {
  return detail::target_specular(terms, i, specular);
}
template <class Count>
static void find_terms(Count count, Terms& terms) noexcept {
  specular_terms(count, terms);
}
)";

// The functions of Mapping, and the loops over a block that call them.
struct RuleParts {
  std::string functions, loops;
};

RuleParts parts_of(const MappingCode& code, bool alpha_by_specular) {
  switch (code.form) {
    case CodeForm::kProportional:
      return {fill_template(kProportionalFunctions,
                            {{"slope", code.is_positive ? "detail::specular_slope(alpha)"
                                                        : "held_channel(detail::specular_slope(alpha))"}}),
              code_files({"proportional"})};
    case CodeForm::kTerms:
      return {fill_template(kTermsFunctions, {{"alpha_by_specular", alpha_by_specular ? "true" : "false"}}),
              code_files({"scale", "terms"})};
    case CodeForm::kRows:
      break;
  }
  return {"", code_files({"scale", "rows_block"})};
}

}  // namespace

std::string block_code(const ConverterHeader& header, const std::string& specular_name,
                       const MappingCode& code) {
  const RuleParts parts = parts_of(code, header.alpha_by_specular);
  return code_files({"lanes", "domain"}) +
         fill_template(kMapping, {{"in_roughness", std::string(convention_name(header.source))},
                                  {"in_specular", specular_name},
                                  {"inverse_edge", literal(1.0 / header.specular.max)},
                                  {"to_alpha", convention_text(header.source).to_alpha},
                                  {"from_alpha", convention_text(header.target).from_alpha},
                                  {"functions", parts.functions}}) +
         code_files({"count_outside"}) + parts.loops;
}

}  // namespace remapc
