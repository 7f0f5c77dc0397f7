// The domain rule as C++, and for each form of a mapping the loops over a block of texels.
#include "emit/block_code.hpp"

#include "emit/text_template.hpp"
#include "model/interpreter.hpp"

namespace remapc {
namespace {

using remap::Fit;
using remap::RoughnessConvention;

// The parts of namespace detail that depend on the form of the mapping (mapping_code.hpp, CodeForm).
constexpr std::string_view kHeldWidth = R"(
// The width as alpha, held in the domain. Floats that are not negative compare as integers do; that vectorises with
// every compiler and under any floating-point flags.
struct HeldWidth {
  float alpha;
  std::uint32_t nan;      // all bits: not a number
  std::uint32_t outside;  // sign bit: out of domain
};

inline HeldWidth held_width(float given) noexcept {
  constexpr std::int32_t kInfinity = 0x7f800000;
  const std::int32_t low = static_cast<std::int32_t>(bits(kDomainMin.@in_roughness@));
  const std::int32_t high = static_cast<std::int32_t>(bits(kDomainMax.@in_roughness@));
  const std::int32_t order = static_cast<std::int32_t>(bits(given + 0.0f));  // -0 becomes 0
  const std::int32_t raised = order < low ? low : order;
  const std::int32_t held = raised > high ? high : raised;
  const float own = float_from_bits(static_cast<std::uint32_t>(held));
  const std::uint32_t nan = (order & 0x7fffffff) > kInfinity ? 0xffffffffu : 0u;
  return {@to_alpha@, nan, held != order ? 0x80000000u : 0u};
}

// The target's own width parameter.
inline float own_width(float alpha) noexcept { return @from_alpha@; }

// Sign bit: whether a channel is out of domain; negative, beyond the edge, or NaN.
inline std::uint32_t channel_outside(float given) noexcept {
  const std::uint32_t order = bits(given + 0.0f);
  return order | (order - bits(kDomainMin.@in_specular@)) | (bits(kDomainMax.@in_specular@) - order);
}

// A channel held at 0 from below; NaN stays.
inline float held_channel(float given) noexcept {
  constexpr std::int32_t kMinusInfinity = -0x00800000;  // 0xff800000
  const std::int32_t order = static_cast<std::int32_t>(bits(given));
  return float_from_bits(static_cast<std::uint32_t>(order <= kMinusInfinity ? 0 : order));
}
)";

// One loop writes one output row: several at once would meet in one set of the cache where maps begin at the
// same offset in their pages, and copies from rows of its own would wait for memory. Loops take their count
// as a constant where the block is full, which gcc needs to vectorise at -O2.
constexpr std::string_view kProportionalBlock = R"(
// A factor for each texel of a block.
struct Block {
  float slope[kBlock];
  std::uint32_t outside[kBlock];
};

template <class Count>
inline void convert_widths(Count count, const float* in, float* out, Block& block) noexcept {
  const std::size_t size = count;
  @independent@
  for (std::size_t i = 0; i < size; ++i) {
    const HeldWidth held = held_width(in[i]);
    out[i] = float_from_bits(bits(own_width(target_alpha(held.alpha))) | held.nan);
    block.slope[i] = float_from_bits(bits(@slope@) | held.nan);
    block.outside[i] = held.outside;
  }
}

template <class Count>
inline void convert_channel(Count count, const float* in, float* out, Block& block) noexcept {
  const std::size_t size = count;
  @independent@
  for (std::size_t i = 0; i < size; ++i) {
    const float given = in[i];
    block.outside[i] |= channel_outside(given);
    out[i] = held_channel(given) * block.slope[i];
  }
}

template <std::size_t Channels, class Count>
inline std::size_t convert_block(Count count, const float* width, const std::array<const float*, Channels>& specular,
                                 float* width_out, const std::array<float*, Channels>& specular_out) noexcept {
  Block block;
  convert_widths(count, width, width_out, block);
  for (std::size_t c = 0; c < Channels; ++c) convert_channel(count, specular[c], specular_out[c], block);
  return count_outside(count, block.outside);
}
)";

constexpr std::string_view kCountOutside = R"(
template <class Count>
inline std::size_t count_outside(Count count, const std::uint32_t* outside) noexcept {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += outside[i] >> 31;
  return sum;
}
)";

// What the channels of a texel share where the mapping is no factor: the scale that brings the largest
// channel to the edge of the domain.
constexpr std::string_view kScale = R"(
// Beyond the largest of these a channel is left as it is, as infinity and NaN are.
inline constexpr float kLargestChannel = 1e30f;

// The larger of `largest`, bits of a float from 0, and a channel that is not left as it is. A mask in place of a
// comparison: compilers would branch on it.
inline std::int32_t larger_channel(std::int32_t largest, float given) noexcept {
  const std::uint32_t kept = bits(kLargestChannel) - bits(given);  // sign bit: beyond, or negative
  const std::int32_t counted = static_cast<std::int32_t>(bits(given)) & ~(static_cast<std::int32_t>(kept) >> 31);
  return counted > largest ? counted : largest;
}

// The ratio of the largest channel to the edge, from 1. Without a comparison: compilers would branch on it.
inline float channel_scale(float largest) noexcept {
  const std::int32_t one = static_cast<std::int32_t>(bits(1.0f));
  const std::int32_t above = static_cast<std::int32_t>(bits(largest * @inverse_edge@)) - one;
  return float_from_bits(static_cast<std::uint32_t>((above & ~(above >> 31)) + one));
}

// The channel, held at 0 from below, where it is left as it is; otherwise what it was mapped to.
inline float kept_or_mapped(float held, float mapped) noexcept {
  const std::int32_t order = static_cast<std::int32_t>(bits(held) & 0x7fffffffu);
  const std::uint32_t kept = static_cast<std::uint32_t>((static_cast<std::int32_t>(bits(kLargestChannel)) - order) >> 31);
  return float_from_bits((bits(held) & kept) | (bits(mapped) & ~kept));
}
)";

// Where no channel of a block is out of domain, as in most, nothing is scaled, and the block takes a shorter
// way to the same bits: a factor of 1.
constexpr std::string_view kTermsBlock = R"(
inline constexpr bool kAlphaBySpecular = @alpha_by_specular@;  // whether target alpha depends on specular

// What the channels of a texel share. `scale` brings the largest, `top`, to the edge of the domain, and is 1 inside; NaN
// where the width is NaN.
struct Block {
  float top[kBlock], scale[kBlock], inverse[kBlock];
  Terms terms;
};

struct Outside {
  std::uint32_t texel_count;
  std::uint32_t channels;  // sign bit: whether any channel of the block is out of domain
};

template <class Count, std::size_t... Channel>
inline Outside look_at_texels(Count count, const float* width, const std::array<const float*, sizeof...(Channel)>& specular,
                              Block& block, std::index_sequence<Channel...>) noexcept {
  const std::size_t size = count;
  std::uint32_t texel_count = 0, channels = 0;
  @independent@
  for (std::size_t i = 0; i < size; ++i) {
    const HeldWidth held = held_width(width[i]);
    const std::uint32_t outside = (channel_outside(specular[Channel][i]) | ...);
    block.terms.alpha[i] = held.alpha;
    block.scale[i] = float_from_bits(bits(1.0f) | held.nan);
    channels |= outside;
    texel_count += (held.outside | outside) >> 31;
  }
  return {texel_count, channels};
}

template <class Count, std::size_t... Channel>
inline void scale_texels(Count count, const std::array<const float*, sizeof...(Channel)>& specular, Block& block,
                         std::index_sequence<Channel...>) noexcept {
  const std::size_t size = count;
  @independent@
  for (std::size_t i = 0; i < size; ++i) {
    std::int32_t largest = 0;
    ((largest = larger_channel(largest, specular[Channel][i])), ...);
    const float top = float_from_bits(static_cast<std::uint32_t>(largest));
    const float scale = channel_scale(top);
    block.inverse[i] = 1.0f / scale;
    block.top[i] = top * block.inverse[i];
    block.scale[i] = scale * block.scale[i];
  }
}

// The largest channel, all being inside.
template <class Count, std::size_t... Channel>
inline void find_tops(Count count, const std::array<const float*, sizeof...(Channel)>& specular, Block& block,
                      std::index_sequence<Channel...>) noexcept {
  const std::size_t size = count;
  @independent@
  for (std::size_t i = 0; i < size; ++i) {
    std::int32_t largest = 0;
    ((largest = larger_channel(largest, specular[Channel][i])), ...);
    block.top[i] = float_from_bits(static_cast<std::uint32_t>(largest));
  }
}

template <class Count>
inline void convert_widths(Count count, float* out, Block& block) noexcept {
  const std::size_t size = count;
  @independent@
  for (std::size_t i = 0; i < size; ++i) {
    const float top = kAlphaBySpecular ? block.top[i] : 0.0f;
    const std::uint32_t nan = (bits(block.scale[i]) & 0x7fffffffu) > 0x7f800000u ? 0xffffffffu : 0u;
    out[i] = float_from_bits(bits(own_width(target_alpha(block.terms.alpha[i], top))) | nan);
  }
}

template <bool kInside, class Count>
inline void convert_channel(Count count, const float* in, float* out, Block& block) noexcept {
  const std::size_t size = count;
  @independent@
  for (std::size_t i = 0; i < size; ++i) {
    if constexpr (kInside) {
      const float mapped = target_specular(block.terms, i, in[i] + 0.0f);  // -0 becomes 0
      out[i] = held_channel(mapped) * block.scale[i];
    } else {
      const float held = held_channel(in[i]);
      const float mapped = target_specular(block.terms, i, held * block.inverse[i]);
      out[i] = kept_or_mapped(held, held_channel(mapped)) * block.scale[i];
    }
  }
}

template <std::size_t Channels, class Count>
inline std::size_t convert_block(Count count, const float* width, const std::array<const float*, Channels>& specular,
                                 float* width_out, const std::array<float*, Channels>& specular_out) noexcept {
  constexpr auto kChannels = std::make_index_sequence<Channels>();
  Block block;
  const Outside outside = look_at_texels(count, width, specular, block, kChannels);
  const bool inside = outside.channels >> 31 == 0;
  if (!inside)
    scale_texels(count, specular, block, kChannels);
  else if (kAlphaBySpecular)
    find_tops(count, specular, block, kChannels);
  convert_widths(count, width_out, block);
  specular_terms(count, block.terms);
  for (std::size_t c = 0; c < Channels; ++c) {
    if (inside)
      convert_channel<true>(count, specular[c], specular_out[c], block);
    else
      convert_channel<false>(count, specular[c], specular_out[c], block);
  }
  return outside.texel_count;
}
)";

constexpr std::string_view kRowsBlock = R"(
// What the channels of a texel share: `scale` brings the largest to the edge of the domain, 1 inside.
struct Block {
  float scale[kBlock], inverse[kBlock], alpha[kBlock], held[kBlock], mapped[kBlock];
  std::uint32_t outside[kBlock];
};

template <std::size_t... Channel>
inline void look_at_texels(std::size_t count, const float* width, const std::array<const float*, sizeof...(Channel)>& specular,
                           Block& block, std::index_sequence<Channel...>) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const HeldWidth held = held_width(width[i]);
    std::int32_t largest = 0;
    ((largest = larger_channel(largest, specular[Channel][i])), ...);
    const float top = float_from_bits(static_cast<std::uint32_t>(largest));
    const float scale = channel_scale(top);
    block.alpha[i] = held.alpha;
    block.inverse[i] = 1.0f / scale;
    block.scale[i] = float_from_bits(bits(scale) | held.nan);
    block.held[i] = top * block.inverse[i];
    block.outside[i] = held.outside | (channel_outside(specular[Channel][i]) | ...);
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
inline std::size_t convert_block(Count count, const float* width, const std::array<const float*, Channels>& specular,
                                 float* width_out, const std::array<float*, Channels>& specular_out) noexcept {
  Block block{};
  look_at_texels(count, width, specular, block, std::make_index_sequence<Channels>());
  target_alpha_rows(count, block.alpha, block.held, block.mapped);
  for (std::size_t i = 0; i < count; ++i) {  // the scale carries the NaN of a width
    const std::uint32_t nan = (bits(block.scale[i]) & 0x7fffffffu) > 0x7f800000u ? 0xffffffffu : 0u;
    width_out[i] = float_from_bits(bits(own_width(block.mapped[i])) | nan);
  }
  for (std::size_t c = 0; c < Channels; ++c) convert_channel(count, specular[c], specular_out[c], block);
  std::size_t outside_count = 0;
  for (std::size_t i = 0; i < count; ++i) outside_count += block.outside[i] >> 31;
  return outside_count;
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

// The part of namespace detail that the form of the mapping decides.
std::string conversion(const MappingCode& code, const Fit& fit) {
  const std::string independent(kIndependentLoop);
  const std::string scale =
      fill_template(kScale, {{"inverse_edge", literal(1.0 / remap::specular_range(fit).max)}});
  switch (code.form) {
    case CodeForm::kProportional:
      return std::string(kCountOutside) +
             fill_template(kProportionalBlock,
                           {{"independent", independent},
                            {"slope", code.is_positive ? "specular_slope(held.alpha)"
                                                       : "held_channel(specular_slope(held.alpha))"}});
    case CodeForm::kTerms: {
      const char* by_specular = remap::alpha_depends_on_specular(fit.mapping) ? "true" : "false";
      return scale +
             fill_template(kTermsBlock, {{"independent", independent}, {"alpha_by_specular", by_specular}});
    }
    case CodeForm::kRows:
      return scale + fill_template(kRowsBlock, {{"independent", independent}});
  }
  return "";
}

}  // namespace

std::string block_code(const Fit& fit, const MappingCode& code) {
  return fill_template(kHeldWidth,
                       {{"in_roughness", std::string(remap::convention_name(fit.source.roughness))},
                        {"in_specular", fit.source.specular},
                        {"to_alpha", to_alpha_code(fit.source.roughness)},
                        {"from_alpha", from_alpha_code(fit.target.roughness)}}) +
         conversion(code, fit);
}

}  // namespace remapc
