// The domain rule as C++: the text of runtime/stages/code, which texremap also runs over vectors of texels,
// with the definitions that this text needs.
#include <limits>
#include <optional>

#include "emit/convention_text.hpp"
#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"

namespace remap {
namespace {

// What the rule needs of one converter.
constexpr std::string_view kMapping = R"(
// What is this converter's own: its domain, the conventions of its widths and its functions.
struct Mapping {
  static constexpr Domain domain{@width_min@, @width_max@, @specular_min@, @specular_max@, @inverse_edge@};
  static constexpr bool source_root = @source_root@, target_root = @target_root@;  // whether roots are taken
  [[gnu::always_inline]] static float alpha_of(float own) noexcept { return @to_alpha@; }
  [[gnu::always_inline]] static float own_of(float alpha) noexcept { return @from_alpha@; }
  @functions@
};
)";

constexpr std::string_view kProportionalFunctions =
    R"([[gnu::always_inline]] static float target_alpha(float alpha, std::size_t) noexcept { return detail::target_alpha(alpha); }
[[gnu::always_inline]] static float specular_slope(float alpha, std::size_t) noexcept { return @slope@; }
)";

constexpr std::string_view kTermsFunctions =
    R"(static constexpr bool alpha_by_specular = @alpha_by_specular@;  // whether target alpha depends on specular
[[gnu::always_inline]] static float target_alpha(const Terms& terms, std::size_t i, float top) noexcept {
  return detail::target_alpha(terms.alpha[i], top);
}
[[gnu::always_inline]] static float target_specular(const Terms& terms, std::size_t i, float specular) noexcept {
  return detail::target_specular(terms, i, specular);
}
template <class Count>
static void find_terms(Count count, Terms& terms) noexcept {
  specular_terms(count, terms);
}
)";

constexpr std::string_view kRegimeFunctions =
    R"(static constexpr bool has_wide = @has_wide@, has_bright = @has_bright@;  // regimes of the table
static constexpr float alpha_limit = @alpha_limit@, specular_limit = @specular_limit@;
static constexpr float alpha_inverse = 200.0f / alpha_limit, specular_inverse = 200.0f / specular_limit;
static constexpr float mapping_to = @mapping_to@;  // the mapping has reached the limit of alpha before
[[gnu::always_inline]] static float wide_specular(const Terms& terms, std::size_t i, float specular) noexcept {
  return @wide_specular@;
}
[[gnu::always_inline]] static float bright_alpha(const Terms& terms, std::size_t i, float specular) noexcept {
  return @bright_alpha@;
}
template <class Count>
static void find_wide_terms(Count, Terms&) noexcept {}
template <class Count>
static void find_bright_terms(Count, Terms&) noexcept {}
)";

// Without a limit: the largest float, which no mapping gives.
std::string limit_literal(const std::optional<float>& limit) {
  return literal(static_cast<double>(limit.value_or(std::numeric_limits<float>::max())));
}

// Calls the function of a regime; one that a table does not have continues the mapping.
std::string regime_call(const std::string& name, const std::optional<LoweredSeries>& regime,
                        const std::string& otherwise) {
  if (!regime) return otherwise;
  const auto clamped = [](const std::string& value, float least) {
    return "clamped_above(" + value + ", " + literal(static_cast<double>(least)) + ")";
  };
  return "detail::" + name + "(" + clamped("terms.source_alpha[i]", regime->alpha_from) + ", " +
         clamped("specular", regime->specular_from) + ")";
}

std::string truth(bool value) { return value ? "true" : "false"; }

std::string regime_functions(const Lowered& lowered) {
  const auto wide = lowered.wide ? std::optional(lowered.wide->specular) : std::nullopt;
  std::optional<float> mapping_to;
  if (lowered.wide) mapping_to = lowered.wide->mapping_to;
  return fill_template(
      kRegimeFunctions,
      {{"has_wide", truth(wide.has_value())},
       {"has_bright", truth(lowered.bright.has_value())},
       {"alpha_limit", limit_literal(lowered.alpha_limit)},
       {"specular_limit", limit_literal(lowered.specular_limit)},
       {"mapping_to", limit_literal(mapping_to)},
       {"wide_specular", regime_call("wide_specular", wide, "detail::target_specular(terms, i, specular)")},
       {"bright_alpha",
        regime_call("bright_alpha", lowered.bright, "detail::target_alpha(terms.alpha[i], specular)")}});
}

// The functions of Mapping, and the loops over a block that call them.
struct RuleParts {
  std::string functions, loops;
};

bool alpha_depends_on_specular(const Lowered& lowered) {
  return lowered.alpha.polynomial.degrees.size() > 1 || lowered.bright.has_value();
}

RuleParts parts_of(const ConverterData& converter, const MappingCode& code) {
  const std::string by_specular = truth(alpha_depends_on_specular(converter.lowered));
  switch (code.form) {
    case CodeForm::kProportional:
      return {fill_template(kProportionalFunctions,
                            {{"slope", code.is_positive ? "detail::specular_slope(alpha)"
                                                        : "clamped_channel(detail::specular_slope(alpha))"}}),
              code_files({"proportional"})};
    case CodeForm::kTerms:
      return {fill_template(kTermsFunctions, {{"alpha_by_specular", by_specular}}),
              code_files({"scale", "texels", "terms"})};
    case CodeForm::kRegimes:
      break;
  }
  return {fill_template(kTermsFunctions, {{"alpha_by_specular", by_specular}}) +
              regime_functions(converter.lowered),
          code_files({"scale", "texels", "regimes"})};
}

}  // namespace

std::string block_code(const ConverterData& converter, const MappingCode& code) {
  const ConverterInfo& info = converter.info;
  const RuleParts parts = parts_of(converter, code);
  const ConventionText source = convention_text(info.source.roughness),
                       target = convention_text(info.target.roughness);
  return code_files({"lanes", "domain"}) + (takes_roots(info) ? code_files({"roots"}) : "") +
         (code.form == CodeForm::kRegimes ? code_files({"limits"}) : "") +
         fill_template(kMapping, {{"width_min", literal(info.roughness.min)},
                                  {"width_max", literal(info.roughness.max)},
                                  {"specular_min", literal(info.specular.min)},
                                  {"specular_max", literal(info.specular.max)},
                                  {"inverse_edge", literal(1.0 / info.specular.max)},
                                  {"source_root", truth(source.alpha_is_root)},
                                  {"target_root", truth(target.takes_root)},
                                  {"to_alpha", source.to_alpha},
                                  {"from_alpha", target.from_alpha},
                                  {"functions", parts.functions}}) +
         code_files({"count_outside"}) + parts.loops;
}

}  // namespace remap
