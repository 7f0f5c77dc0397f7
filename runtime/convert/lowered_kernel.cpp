// The domain rule is that of generated headers (compiler/emit/header.cpp), step by step over blocks of
// texels: every loop runs over a whole block, so that compilers vectorise it for every instruction set and a
// texel takes the same way wherever in its row it stands.
#include "convert/lowered_kernel.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "convert/instruction_target.hpp"
#include "lower/emitted_order.hpp"

namespace remap {
namespace {

constexpr std::size_t kBlock = 128;
constexpr std::size_t kMostChannels = 3;
// Beyond the largest of these a channel is left as it is, as infinity and NaN are.
constexpr float kLargestChannel = 1e30f;
constexpr std::int32_t kInfinity = 0x7f800000;
constexpr std::int32_t kMinusInfinity = -0x00800000;  // 0xff800000; floats from there down to it are negative

using Row = float[kBlock];

struct Block {
  Row width, channels[kMostChannels];  // as given, then converted
  Row alpha, largest, scale, inverse;
  Row u, square, next, specular, mapped, factors[kMostPowers];
  std::int32_t cell[kBlock];
  std::uint32_t nan[kBlock];      // all bits: the width is not a number
  std::uint32_t outside[kBlock];  // sign bit: out of domain
};

REMAP_INLINED_FUNCTIONS_BEGIN

std::int32_t order_of(float value) noexcept { return std::bit_cast<std::int32_t>(value); }
float float_of(std::int32_t order) noexcept { return std::bit_cast<float>(order); }
float with_bits(float value, std::uint32_t more) noexcept {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) | more);
}

// Floats that are not negative compare as integers do, which vectorises with every compiler.
void look_at_channel(const LoweredPass& pass, const Row& channel, Block& block) noexcept {
  const std::int32_t limit = order_of(kLargestChannel);
  const std::uint32_t low = std::bit_cast<std::uint32_t>(pass.specular_min);
  const std::uint32_t high = std::bit_cast<std::uint32_t>(pass.specular_max);
  for (std::size_t i = 0; i < kBlock; ++i) {
    const std::int32_t order = order_of(channel[i]);
    const std::int32_t counted = order > limit ? 0 : order, largest = order_of(block.largest[i]);
    block.largest[i] = float_of(counted > largest ? counted : largest);
    const std::uint32_t given = std::bit_cast<std::uint32_t>(channel[i] + 0.0f);  // -0 becomes 0
    block.outside[i] |= given | (given - low) | (high - given);
  }
}

void hold_width(const LoweredPass& pass, Block& block) noexcept {
  const std::int32_t low = order_of(pass.roughness_min), high = order_of(pass.roughness_max);
  for (std::size_t i = 0; i < kBlock; ++i) {
    const std::int32_t order = order_of(block.width[i] + 0.0f);
    const std::int32_t raised = order < low ? low : order;
    const std::int32_t held = raised > high ? high : raised;
    block.alpha[i] = float_of(held);
    block.nan[i] = (order & 0x7fffffff) > kInfinity ? 0xffffffffu : 0u;
    block.outside[i] |= held != order ? 0x80000000u : 0u;
  }
}

void to_alpha(RoughnessConvention convention, Row& row) noexcept {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      return;
    case RoughnessConvention::kRoughness:
      for (float& own : row) own = own * own;
      return;
    case RoughnessConvention::kExponent:
      for (float& own : row) own = std::sqrt(2.0f / (own + 2.0f));
      return;
    case RoughnessConvention::kGlossiness:
      for (float& own : row) own = (1.0f - own) * (1.0f - own);
      return;
    case RoughnessConvention::kSquared:
      for (float& own : row) own = std::sqrt(own);
      return;
  }
}

void from_alpha(RoughnessConvention convention, Row& row) noexcept {
  switch (convention) {
    case RoughnessConvention::kAlpha:
      return;
    case RoughnessConvention::kRoughness:
      for (float& alpha : row) alpha = std::sqrt(alpha);
      return;
    case RoughnessConvention::kExponent:
      for (float& alpha : row) alpha = 2.0f / (alpha * alpha) - 2.0f;
      return;
    case RoughnessConvention::kGlossiness:
      for (float& alpha : row) alpha = 1.0f - std::sqrt(alpha);
      return;
    case RoughnessConvention::kSquared:
      for (float& alpha : row) alpha = alpha * alpha;
      return;
  }
}

// The ratio of the largest channel to the edge, from 1, and what it leaves of that channel.
void find_scale(const LoweredPass& pass, Block& block) noexcept {
  const float inverse_edge = 1.0f / pass.specular_max;
  const std::int32_t one = order_of(1.0f);
  for (std::size_t i = 0; i < kBlock; ++i) {
    const std::int32_t ratio = order_of(block.largest[i] * inverse_edge);
    block.scale[i] = float_of(ratio > one ? ratio : one);
    block.inverse[i] = 1.0f / block.scale[i];
    block.specular[i] = block.largest[i] * block.inverse[i];
  }
}

// block.u and block.cell of block.alpha (lower/lowered.hpp, PiecewisePolynomial).
void find_cell(const PiecewisePolynomial& shape, Block& block) noexcept {
  const float scale = shape.scale, start = shape.start, pole = shape.pole;
  if (pole == 0.0f)
    for (std::size_t i = 0; i < kBlock; ++i) block.u[i] = block.alpha[i] * scale - start;
  else
    for (std::size_t i = 0; i < kBlock; ++i)
      block.u[i] = block.alpha[i] / (block.alpha[i] + pole) * scale - start;
  if (shape.cell_count == 1) return;
  const std::int32_t last = shape.cell_count - 1;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const std::int32_t down = static_cast<std::int32_t>(block.u[i]);
    const std::int32_t raised = down < 0 ? 0 : down;
    block.cell[i] = raised > last ? last : raised;
    block.u[i] = block.u[i] - (static_cast<float>(block.cell[i]) + 0.5f);
  }
}

// A polynomial in block.u, in the order of operations that its bound was proven for (in_emitted_order):
// `number_at(k, i)` is the coefficient of u^k for texel i.
template <typename NumberAt>
void sum_row(int degree, const NumberAt& number_at, Block& block, Row& sum) noexcept {
  Row& next = block.next;
  for (std::size_t i = 0; i < kBlock; ++i) sum[i] = degree < 0 ? 0.0f : number_at(degree, i);
  if (degree < kShortestSplit) {
    for (int k = degree - 1; k >= 0; --k)
      for (std::size_t i = 0; i < kBlock; ++i) sum[i] = sum[i] * block.u[i] + number_at(k, i);
    return;
  }
  for (std::size_t i = 0; i < kBlock; ++i) next[i] = number_at(degree - 1, i);
  int k = degree - 2;
  for (; k > 0; k -= 2)
    for (std::size_t i = 0; i < kBlock; ++i) {
      sum[i] = sum[i] * block.square[i] + number_at(k, i);
      next[i] = next[i] * block.square[i] + number_at(k - 1, i);
    }
  if (k == 0)
    for (std::size_t i = 0; i < kBlock; ++i)
      sum[i] = next[i] * block.u[i] + (sum[i] * block.square[i] + number_at(0, i));
  else
    for (std::size_t i = 0; i < kBlock; ++i) sum[i] = sum[i] * block.u[i] + next[i];
}

// block.factors: c_p(block.alpha) of every power p.
void find_factors(const PolynomialRows& polynomial, Block& block) noexcept {
  find_cell(polynomial.shape, block);
  for (std::size_t i = 0; i < kBlock; ++i) block.square[i] = block.u[i] * block.u[i];
  const std::size_t cells = static_cast<std::size_t>(polynomial.shape.cell_count);
  const float* numbers = polynomial.numbers.data();
  for (std::size_t power = 0; power < polynomial.shape.degrees.size(); ++power) {
    const int degree = polynomial.shape.degrees[power];
    const auto of_one_cell = [numbers](int k, std::size_t) { return numbers[k]; };
    const auto of_many_cells = [&block, numbers, cells](int k, std::size_t i) {
      return numbers[static_cast<std::size_t>(k) * cells + static_cast<std::size_t>(block.cell[i])];
    };
    if (cells == 1)
      sum_row(degree, of_one_cell, block, block.factors[power]);
    else
      sum_row(degree, of_many_cells, block, block.factors[power]);
    numbers += static_cast<std::size_t>(degree + 1) * cells;
  }
}

// block.mapped: the sum over the powers of block.specular.
void sum_powers(const PiecewisePolynomial& shape, Block& block) noexcept {
  std::size_t power = shape.degrees.size() - 1;
  for (std::size_t i = 0; i < kBlock; ++i) block.mapped[i] = block.factors[power][i];
  while (power-- > 0) {
    const Row& factors = block.factors[power];
    for (std::size_t i = 0; i < kBlock; ++i)
      block.mapped[i] = block.mapped[i] * (block.specular[i] - shape.middle) + factors[i];
  }
}

void convert_width(const LoweredPass& pass, Block& block) noexcept {
  find_factors(pass.alpha, block);
  sum_powers(pass.alpha.shape, block);
  from_alpha(pass.target, block.mapped);
  for (std::size_t i = 0; i < kBlock; ++i) {
    block.width[i] = with_bits(block.mapped[i], block.nan[i]);
    block.scale[i] = with_bits(block.scale[i], block.nan[i]);
  }
}

// The factors of target specular must stand in the block. Below 0 a channel is held there, before and after.
void convert_channel(const LoweredPass& pass, Row& channel, Block& block) noexcept {
  const std::int32_t limit = order_of(kLargestChannel);
  for (std::size_t i = 0; i < kBlock; ++i) {
    const std::int32_t order = order_of(channel[i]);
    block.specular[i] = float_of(order < 0 || order > limit ? 0 : order) * block.inverse[i];
  }
  sum_powers(pass.specular.shape, block);
  for (std::size_t i = 0; i < kBlock; ++i) {
    const std::int32_t order = order_of(channel[i]);
    const bool kept = order > limit || (order & 0x7fffffff) > kInfinity;
    const std::int32_t mapped = order_of(block.mapped[i]);
    const std::int32_t raised = mapped <= kMinusInfinity ? 0 : mapped;
    channel[i] = float_of(kept ? order : raised) * block.scale[i];
  }
}

void convert_block(const LoweredPass& pass, std::size_t channels, Block& block) noexcept {
  for (std::size_t i = 0; i < kBlock; ++i) {
    block.largest[i] = 0.0f;
    block.outside[i] = 0;
  }
  for (std::size_t c = 0; c < channels; ++c) look_at_channel(pass, block.channels[c], block);
  hold_width(pass, block);
  to_alpha(pass.source, block.alpha);
  find_scale(pass, block);
  convert_width(pass, block);
  find_factors(pass.specular, block);
  for (std::size_t c = 0; c < channels; ++c) convert_channel(pass, block.channels[c], block);
}

// A block that the rows do not fill ends with texels that nobody reads.
void load(const float* from, std::size_t size, Row& row) noexcept {
  std::memcpy(row, from, size * sizeof(float));
  if (size < kBlock) std::memset(row + size, 0, (kBlock - size) * sizeof(float));
}

std::size_t convert_rows(const LoweredPass& pass, std::size_t count, const float* roughness,
                         std::span<const float* const> specular, float* roughness_out,
                         std::span<float* const> specular_out) noexcept {
  const float* const* in = specular.data();
  float* const* out = specular_out.data();
  const std::size_t channels = specular.size();
  std::size_t out_of_domain = 0;
  Block block;
  for (std::size_t start = 0; start < count; start += kBlock) {
    const std::size_t size = count - start < kBlock ? count - start : kBlock;
    load(roughness + start, size, block.width);
    for (std::size_t c = 0; c < channels; ++c) load(in[c] + start, size, block.channels[c]);
    convert_block(pass, channels, block);
    std::memcpy(roughness_out + start, block.width, size * sizeof(float));
    for (std::size_t c = 0; c < channels; ++c)
      std::memcpy(out[c] + start, block.channels[c], size * sizeof(float));
    for (std::size_t i = 0; i < size; ++i) out_of_domain += block.outside[i] >> 31;
  }
  return out_of_domain;
}

REMAP_INLINED_FUNCTIONS_END

REMAP_FOR_BASELINE std::size_t convert(const LoweredPass& pass, std::size_t count, const float* roughness,
                                       std::span<const float* const> specular, float* roughness_out,
                                       std::span<float* const> specular_out) noexcept {
  return convert_rows(pass, count, roughness, specular, roughness_out, specular_out);
}

#if REMAP_HAS_X86_SETS
REMAP_FOR_AVX2 std::size_t convert_avx2(const LoweredPass& pass, std::size_t count, const float* roughness,
                                        std::span<const float* const> specular, float* roughness_out,
                                        std::span<float* const> specular_out) noexcept {
  return convert_rows(pass, count, roughness, specular, roughness_out, specular_out);
}

REMAP_FOR_AVX512 std::size_t convert_avx512(const LoweredPass& pass, std::size_t count,
                                            const float* roughness, std::span<const float* const> specular,
                                            float* roughness_out,
                                            std::span<float* const> specular_out) noexcept {
  return convert_rows(pass, count, roughness, specular, roughness_out, specular_out);
}
#endif

}  // namespace

PolynomialRows polynomial_rows(const PiecewisePolynomial& polynomial) {
  PolynomialRows rows{polynomial, std::vector<float>(polynomial.coefficients.size())};
  rows.shape.coefficients.clear();
  const std::size_t width = polynomial.coefficients_a_cell();
  const std::size_t cells = static_cast<std::size_t>(polynomial.cell_count);
  for (std::size_t cell = 0; cell < cells; ++cell)
    for (std::size_t i = 0; i < width; ++i)
      rows.numbers[i * cells + cell] = polynomial.coefficients[cell * width + i];
  return rows;
}

LoweredKernel lowered_kernel(InstructionSet set) {
#if REMAP_HAS_X86_SETS
  if (set == InstructionSet::kAvx512) return &convert_avx512;
  if (set == InstructionSet::kAvx2) return &convert_avx2;
#endif
  static_cast<void>(set);
  return &convert;
}

}  // namespace remap
