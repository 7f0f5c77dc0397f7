// The domain rule as C++: the text of runtime/convert/code, which texremap runs over vectors of texels, with
// what it is written over.
#include "emit/block_code.hpp"

#include "emit/code_text.hpp"
#include "emit/text_template.hpp"
#include "model/interpreter.hpp"

namespace remapc {
namespace {

using remap::Fit;
using remap::RoughnessConvention;

// What the text of the rule is written over, for one texel at a time.
constexpr std::string_view kLanes = R"(
// The rule of the domain is written over these names: one texel here, several in programs with vectors of their own.
using Float = float;
using Bits = std::uint32_t;
inline constexpr std::size_t kLanes = 1;

inline float load(const float* from) noexcept { return *from; }
inline std::uint32_t load(const std::uint32_t* from) noexcept { return *from; }
inline void store(float* to, float value) noexcept { *to = value; }
inline void store(std::uint32_t* to, std::uint32_t value) noexcept { *to = value; }

inline std::int32_t as_signed(std::uint32_t value) noexcept { return static_cast<std::int32_t>(value); }
inline std::uint32_t as_bits(std::int32_t value) noexcept { return static_cast<std::uint32_t>(value); }
// All bits where a > b, as signed numbers.
inline std::uint32_t above(std::uint32_t a, std::uint32_t b) noexcept {
  return as_signed(a) > as_signed(b) ? 0xffffffffu : 0u;
}
// Sign bit where a and b differ. Compilers would branch on a comparison.
inline std::uint32_t differs(std::uint32_t a, std::uint32_t b) noexcept { return (a - b) | (b - a); }
// Compilers know the larger of two signed numbers as one instruction.
inline std::uint32_t larger(std::uint32_t a, std::uint32_t b) noexcept {
  const std::int32_t x = as_signed(a), y = as_signed(b);
  return as_bits(x < y ? y : x);
}
inline std::uint32_t smaller(std::uint32_t a, std::uint32_t b) noexcept {
  const std::int32_t x = as_signed(a), y = as_signed(b);
  return as_bits(x > y ? y : x);
}
inline std::uint32_t all_of_sign(std::uint32_t value) noexcept { return as_bits(as_signed(value) >> 31); }
inline bool any_sign(std::uint32_t value) noexcept { return value >> 31 != 0; }
)";

constexpr std::string_view kCountOutside = R"(
template <class Count>
inline std::size_t count_outside(Count count, const std::uint32_t* outside) noexcept {
  const std::size_t size = count;
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < size; ++i) sum += outside[i] >> 31;
  return sum;
}
)";

// What the rule takes from this converter.
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

constexpr std::string_view kProportionalFunctions = R"(
static float target_alpha(float alpha, std::size_t) noexcept { return detail::target_alpha(alpha); }
static float specular_slope(float alpha, std::size_t) noexcept { return @slope@; }
)";

constexpr std::string_view kTermsFunctions = R"(
static constexpr bool alpha_by_specular = @alpha_by_specular@;  // whether target alpha depends on specular
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

constexpr std::string_view kRowsBlock = R"(
// What the channels of a texel share: `scale` brings the largest to the edge of the domain, 1 inside.
struct Block {
  float scale[kBlock] = {}, inverse[kBlock] = {}, alpha[kBlock] = {}, held[kBlock] = {}, mapped[kBlock] = {};
  std::uint32_t outside[kBlock] = {};
};

template <std::size_t... Channel>
inline void look_at_texels(std::size_t count, const float* width, const float* const* specular, Block& block,
                           std::index_sequence<Channel...>) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const HeldWidth held = held_width(Mapping::domain, width[i]);
    std::uint32_t largest = 0;
    ((largest = larger_channel(largest, specular[Channel][i])), ...);
    const float top = float_from_bits(largest);
    const float scale = channel_scale(Mapping::domain, top);
    block.alpha[i] = Mapping::alpha_of(held.own);
    block.inverse[i] = 1.0f / scale;
    block.scale[i] = with_nan(scale, held.nan);
    block.held[i] = top * block.inverse[i];
    block.outside[i] = held.outside | (channel_outside(Mapping::domain, specular[Channel][i]) | ...);
  }
}

inline void convert_channel(std::size_t count, const float* in, float* out, Block& block) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t order = static_cast<std::int32_t>(bits(held_channel(in[i])));
    const bool kept = order > static_cast<std::int32_t>(bits(kLargestChannel));
    block.held[i] = float_from_bits(kept ? 0u : static_cast<std::uint32_t>(order)) * block.inverse[i];
  }
  target_specular_rows(count, block.alpha, block.held, block.mapped);
  const std::size_t size = count;
  @independent@
  for (std::size_t i = 0; i < size; ++i) out[i] = kept_or_mapped(held_channel(in[i]), held_channel(block.mapped[i])) * block.scale[i];
}

template <std::size_t Channels, class Count>
inline void convert_block(Count count, Mapping, const float* width, const float* const* specular, float* width_out,
                          float* const* specular_out, Block& block) noexcept {
  look_at_texels(count, width, specular, block, std::make_index_sequence<Channels>());
  target_alpha_rows(count, block.alpha, block.held, block.mapped);
  for (std::size_t i = 0; i < count; ++i) {  // the scale carries the NaN of a width
    const std::uint32_t nan = above(bits(block.scale[i]) & 0x7fffffffu, 0x7f800000u);
    width_out[i] = with_nan(Mapping::own_of(block.mapped[i]), nan);
  }
  for (std::size_t c = 0; c < Channels; ++c) convert_channel(count, specular[c], specular_out[c], block);
}
)";

// Expressions in the generated code, of `own`, the source's parameter, and of `alpha`.
std::string to_alpha_code(RoughnessConvention convention) {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      return "own";
    case RoughnessConvention::kRoughness:
      return "own * own";
    case RoughnessConvention::kExponent:
      return "std::sqrt(2.0f / (own + 2.0f))";
    case RoughnessConvention::kGlossiness:
      return "(1.0f - own) * (1.0f - own)";
    case RoughnessConvention::kSquared:
      return "std::sqrt(own)";
  }
  return "own";
}

std::string from_alpha_code(RoughnessConvention convention) {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      return "alpha";
    case RoughnessConvention::kRoughness:
      return "std::sqrt(alpha)";
    case RoughnessConvention::kExponent:
      return "2.0f / (alpha * alpha) - 2.0f";
    case RoughnessConvention::kGlossiness:
      return "1.0f - std::sqrt(alpha)";
    case RoughnessConvention::kSquared:
      return "alpha * alpha";
  }
  return "alpha";
}

// A text of runtime/convert/code for headers, where loops that may be vectorised say so.
std::string rule(std::string_view text) {
  constexpr std::string_view kMark = "REMAP_INDEPENDENT_LOOP";
  std::string marked(text);
  for (std::size_t at = marked.find(kMark); at != std::string::npos; at = marked.find(kMark, at))
    marked.replace(at, kMark.size(), "@independent@");
  if (marked.find('@') == std::string::npos) return "\n" + marked;
  return "\n" + fill_template(marked, {{"independent", std::string(kIndependentLoop)}});
}

std::string mapping_functions(const MappingCode& code, const Fit& fit) {
  switch (code.form) {
    case CodeForm::kProportional:
      return fill_template(kProportionalFunctions,
                           {{"slope", code.is_positive ? "detail::specular_slope(alpha)"
                                                       : "held_channel(detail::specular_slope(alpha))"}});
    case CodeForm::kTerms:
      return fill_template(
          kTermsFunctions,
          {{"alpha_by_specular", remap::alpha_depends_on_specular(fit.mapping) ? "true" : "false"}});
    case CodeForm::kRows:
      return "";
  }
  return "";
}

// The loops over a block.
std::string loops(CodeForm form) {
  switch (form) {
    case CodeForm::kProportional:
      return rule(kProportionalText);
    case CodeForm::kTerms:
      return rule(kScaleText) + rule(kTermsText);
    case CodeForm::kRows:
      return rule(kScaleText) + fill_template(kRowsBlock, {{"independent", std::string(kIndependentLoop)}});
  }
  return "";
}

}  // namespace

std::string block_code(const Fit& fit, const MappingCode& code) {
  std::string functions = mapping_functions(code, fit);
  if (!functions.empty()) functions.erase(0, 1);
  return std::string(kLanes) + rule(kDomainText) +
         fill_template(kMapping, {{"in_roughness", std::string(remap::convention_name(fit.source.roughness))},
                                  {"in_specular", fit.source.specular},
                                  {"inverse_edge", literal(1.0 / remap::specular_range(fit).max)},
                                  {"to_alpha", to_alpha_code(fit.source.roughness)},
                                  {"from_alpha", from_alpha_code(fit.target.roughness)},
                                  {"functions", functions}}) +
         std::string(kCountOutside) + loops(code.form);
}

}  // namespace remapc
