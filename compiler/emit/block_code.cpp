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

constexpr std::string_view kRegimeFunctions =
    R"(// The limits of the target, and between which widths its regimes take over.
static constexpr bool has_wide = @has_wide@, has_bright = @has_bright@;
static constexpr float alpha_limit = @alpha_limit@, specular_limit = @specular_limit@;
static constexpr float mapping_to = @mapping_to@, wide_from = @wide_from@;
static constexpr float bright_alpha_from = @bright_alpha_from@, bright_from = @bright_from@;
static float held_above(float value, float least) noexcept {
  return float_from_bits(larger(bits(value), bits(least)));
}
static float wide_specular(const Terms& terms, std::size_t i, float specular) noexcept {
  @wide_specular@
}
static float bright_alpha(const Terms& terms, std::size_t i, float specular) noexcept {
  @bright_alpha@
}
template <class Count>
static void find_wide_terms(Count, Terms&) noexcept {}
template <class Count>
static void find_bright_terms(Count, Terms&) noexcept {}
)";

// Without a limit: larger than any number that a mapping gives.
std::string limit_literal(const std::optional<float>& limit) {
  return limit ? literal(static_cast<double>(*limit)) : "3.4028235e38f";
}

// A regime that a table does not have continues the mapping.
std::string regime_functions(const remap::Lowered& lowered) {
  const auto& wide = lowered.wide;
  const auto& bright = lowered.bright;
  const auto truth = [](bool value) { return std::string(value ? "true" : "false"); };
  return fill_template(
      kRegimeFunctions,
      {{"has_wide", truth(wide.has_value())},
       {"has_bright", truth(bright.has_value())},
       {"alpha_limit", limit_literal(lowered.alpha_limit)},
       {"specular_limit", limit_literal(lowered.specular_limit)},
       {"mapping_to", limit_literal(wide ? std::optional(wide->mapping_to) : std::nullopt)},
       {"wide_from", literal(wide ? static_cast<double>(wide->from) : 0.0)},
       {"bright_alpha_from", literal(bright ? static_cast<double>(bright->alpha_from) : 0.0)},
       {"bright_from", literal(bright ? static_cast<double>(bright->specular_from) : 0.0)},
       {"wide_specular",
        wide ? "return detail::wide_specular(held_above(terms.source_alpha[i], wide_from), specular);"
             : "return detail::target_specular(terms, i, specular);"},
       {"bright_alpha", bright ? "return detail::bright_alpha(held_above(terms.source_alpha[i], bright_alpha_from), specular);"
                               : "return detail::target_alpha(terms.alpha[i], specular);"}});
}

// The functions of Mapping, and the loops over a block that call them.
struct RuleParts {
  std::string functions, loops;
};

RuleParts parts_of(const ConverterHeader& header, const MappingCode& code) {
  const std::string by_specular = header.alpha_by_specular ? "true" : "false";
  switch (code.form) {
    case CodeForm::kProportional:
      return {fill_template(kProportionalFunctions,
                            {{"slope", code.is_positive ? "detail::specular_slope(alpha)"
                                                        : "held_channel(detail::specular_slope(alpha))"}}),
              code_files({"proportional"})};
    case CodeForm::kTerms:
      return {fill_template(kTermsFunctions, {{"alpha_by_specular", by_specular}}),
              code_files({"scale", "texels", "terms"})};
    case CodeForm::kRegimes:
      return {fill_template(kTermsFunctions, {{"alpha_by_specular", by_specular}}) +
                  regime_functions(std::get<remap::Lowered>(header.mapping.code)),
              code_files({"scale", "texels", "regimes"})};
    case CodeForm::kRows:
      break;
  }
  return {"", code_files({"scale", "rows_block"})};
}

}  // namespace

std::string block_code(const ConverterHeader& header, const std::string& specular_name,
                       const MappingCode& code) {
  const RuleParts parts = parts_of(header, code);
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
