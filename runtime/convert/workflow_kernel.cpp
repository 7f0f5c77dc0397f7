#include "convert/workflow_kernel.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "convert/instruction_target.hpp"
#include "remap/converter.hpp"

// The standard headers that it asks for stand above: they are none of these functions.
REMAP_INLINED_FUNCTIONS_BEGIN
#include "workflow/workflow_code.hpp"
REMAP_INLINED_FUNCTIONS_END

#include "workflow/conversion.hpp"
#include "workflow/conversion_constants.hpp"

namespace remap {
namespace {

namespace code = workflow_code;

constexpr std::size_t kBlock = code::kMetallicBlock;
// Two answers are this far apart at least.
constexpr float kApart = 0.05f;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

REMAP_INLINED_FUNCTIONS_BEGIN

inline void convert_to_specular(const code::Conventions& use, std::size_t count,
                                const MetallicRows<const float>& in,
                                const SpecularRows<float>& out) noexcept {
  code::convert_rows<code::kSpecularBlock>(count, in, out, [&](const auto& from, const auto& to) {
    return code::metallic_to_specular(use, from, to);
  });
}

inline void convert_to_metallic(const WorkflowConversion& conversion, std::size_t count,
                                const SpecularRows<const float>& in,
                                const MetallicRows<float>& out) noexcept {
  const code::Conventions use = conventions_of(conversion);
  const WorkflowFormula& formula = conversion.formula;
  if (const auto* projection = std::get_if<Projection>(&formula)) {
    const float prior = static_cast<float>(projection->prior);
    code::convert_rows<kBlock>(count, in, out, [&, prior](const auto& from, const auto& to) {
      return code::project(use, prior, from, to);
    });
  } else if (const auto* equation = std::get_if<Equation3>(&formula)) {
    const bool by_albedo = equation->mean == MetallicMean::kAlbedo;
    code::convert_rows<kBlock>(count, in, out, [&, by_albedo](const auto& from, const auto& to) {
      return code::solve_equation_3(use, by_albedo, from, to);
    });
  } else if (std::holds_alternative<KhronosSolver>(formula)) {
    code::convert_rows<kBlock>(
        count, in, out, [&](const auto& from, const auto& to) { return code::solve_khronos(use, from, to); });
  } else {
    convert_workflow(conversion, count, in, out);  // a network, which is interpreted
  }
}

// A block of rows as texels of reflectance and F0. Rows that end within it are filled up with black.
struct TexelBlock {
  code::SpecularTexels texels;
  float alpha[kBlock];
  std::size_t size;
};

inline void read_block(const code::Conventions& use, const SpecularRows<const float>& in, std::size_t start,
                       std::size_t count, TexelBlock& block) noexcept {
  block.size = count - start < kBlock ? count - start : kBlock;
  float given[7][kBlock] = {};
  SpecularRows<const float> rows{};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::memcpy(given[r], in[r] + start, block.size * sizeof(float));
    rows[r] = given[r];
  }
  code::read_specular(use, rows, block.texels);
  for (std::size_t i = 0; i < kBlock; ++i)
    block.alpha[i] = code::width_to_alpha(use.width_in, block.texels.held.row[6][i]);
}

// The starts of the projection: two of them apart, both as good as the best, and what lies between is not.
inline bool has_two_answers(const code::Texel& texel, const code::Conventions& use, float good) noexcept {
  const code::ErrorCurve curve = code::error_curve(texel, use, 0.0f);
  const float both =
      curve.r1 + code::approximate_root(code::from_zero(curve.r1 * curve.r1 - 4.0f * curve.r2 * curve.r0));
  const std::array<float, 3> shares = {code::improved(curve, code::held(both / (2.0f * curve.r2 + 1e-20f))),
                                       code::improved(curve, code::held(2.0f * curve.r0 / (both + 1e-20f))),
                                       code::improved(curve, 0.0f)};
  const auto is_good = [&](float share) { return code::error_of(texel, use, share) <= good; };
  for (std::size_t a = 0; a < shares.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (code::magnitude(shares[a] - shares[b]) < kApart) continue;
      if (is_good(shares[a]) && is_good(shares[b]) && !is_good(0.5f * (shares[a] + shares[b]))) return true;
    }
  return false;
}

inline bool is_beyond(const SpecularRows<const float>& in, std::size_t i) noexcept {
  std::uint32_t sign = 0;
  for (const float* row : in) sign |= code::outside_sign(row[i]);
  return sign >> 31 != 0;
}

inline bool is_dark(const code::Texel& texel) noexcept {
  const auto is_dark_channel = [](const code::Channel& channel) {
    return channel.diffuse < kDarkTexel && channel.f0 < kDarkTexel;
  };
  return is_dark_channel(texel.red) && is_dark_channel(texel.green) && is_dark_channel(texel.blue);
}

inline void diagnose_rows(const code::Conventions& use, std::size_t count,
                          const SpecularRows<const float>& in, const MetallicRows<const float>& result,
                          const DiagnosisRows& out) noexcept {
  TexelBlock block;
  float errors[code::kMetallicSamples];
  for (std::size_t start = 0; start < count; start += kBlock) {
    read_block(use, in, start, count, block);
    for (std::size_t b = 0; b < block.size; ++b) {
      const std::size_t i = start + b;
      const float metallic = result[3][i];
      if (block.texels.nan[b] != 0 || std::isnan(metallic)) {
        out.residual[i] = out.metallic_width[i] = kNan;
        out.doubts[i] = 0.0f;
        continue;
      }
      const code::Texel texel = code::texel_of(block.texels, block.alpha[b], b);
      const float good = code::good_error(texel, use);
      code::sample_errors(texel, use, errors);
      const float width = code::metallic_width(errors, good);
      const bool guess = width > kGuessWidth;
      int doubts = guess ? static_cast<int>(Doubt::kGuess) : 0;
      if (guess && is_dark(texel)) doubts += static_cast<int>(Doubt::kDark);
      if (has_two_answers(texel, use, good)) doubts += static_cast<int>(Doubt::kTwoAnswers);
      if (is_beyond(in, i) || code::is_held(texel, use, metallic))
        doubts += static_cast<int>(Doubt::kClamped);
      out.residual[i] = code::residual_of(texel, use, metallic, result[0][i], result[1][i], result[2][i]);
      out.metallic_width[i] = width;
      out.doubts[i] = static_cast<float>(doubts) / 255.0f;
    }
  }
}

// The nearest to `wanted` of the samples that are good enough, and of 0, 1 and `found`.
inline float nearest_good(const code::Texel& texel, const code::Conventions& use, float wanted, float found,
                          FollowedTexels which) noexcept {
  float errors[code::kMetallicSamples];
  const float good = code::good_error(texel, use);
  code::sample_errors(texel, use, errors);
  if (which == FollowedTexels::kGuesses && code::metallic_width(errors, good) <= kGuessWidth) return found;
  float nearest = found;
  const auto consider = [&](float metallic, float error) {
    if (error <= good && code::magnitude(metallic - wanted) < code::magnitude(nearest - wanted))
      nearest = metallic;
  };
  for (std::size_t s = 0; s < code::kMetallicSamples; ++s) consider(code::sampled_metallic(s), errors[s]);
  consider(0.0f, code::error_of(texel, use, 1.0f));
  consider(1.0f, code::error_of(texel, use, 0.0f));
  return nearest;
}

inline void follow_rows(const code::Conventions& use, std::size_t count, const SpecularRows<const float>& in,
                        const float* wanted, FollowedTexels which,
                        const MetallicRows<float>& result) noexcept {
  TexelBlock block;
  for (std::size_t start = 0; start < count; start += kBlock) {
    read_block(use, in, start, count, block);
    for (std::size_t b = 0; b < block.size; ++b) {
      const std::size_t i = start + b;
      if (block.texels.nan[b] != 0 || std::isnan(result[3][i]) || std::isnan(wanted[i])) continue;
      const code::Texel texel = code::texel_of(block.texels, block.alpha[b], b);
      const float metallic = nearest_good(texel, use, code::held(wanted[i]), result[3][i], which);
      if (metallic == result[3][i]) continue;
      const code::Blend blend = code::blend_of(texel.gram, use, 1.0f - metallic);
      result[0][i] = code::held(code::free_albedo(blend, texel.red.diffuse, texel.red.f0));
      result[1][i] = code::held(code::free_albedo(blend, texel.green.diffuse, texel.green.f0));
      result[2][i] = code::held(code::free_albedo(blend, texel.blue.diffuse, texel.blue.f0));
      result[3][i] = metallic;
    }
  }
}

REMAP_INLINED_FUNCTIONS_END

// One set of kernels: `REMAP_TARGET` stands before each.
#define REMAP_WORKFLOW_KERNELS(SET, NAME, REMAP_TARGET)                                              \
  REMAP_TARGET void to_specular_##SET(const WorkflowConversion& conversion, std::size_t count,       \
                                      const MetallicRows<const float>& in,                           \
                                      const SpecularRows<float>& out) noexcept {                     \
    convert_to_specular(conventions_of(conversion), count, in, out);                                 \
  }                                                                                                  \
  REMAP_TARGET void to_metallic_##SET(const WorkflowConversion& conversion, std::size_t count,       \
                                      const SpecularRows<const float>& in,                           \
                                      const MetallicRows<float>& out) noexcept {                     \
    convert_to_metallic(conversion, count, in, out);                                                 \
  }                                                                                                  \
  REMAP_TARGET void follow_##SET(const WorkflowConversion& conversion, std::size_t count,            \
                                 const SpecularRows<const float>& in, const float* wanted,           \
                                 FollowedTexels which, const MetallicRows<float>& result) noexcept { \
    follow_rows(conventions_of(conversion), count, in, wanted, which, result);                       \
  }                                                                                                  \
  REMAP_TARGET void diagnose_##SET(                                                                  \
      const WorkflowConversion& conversion, std::size_t count, const SpecularRows<const float>& in,  \
      const MetallicRows<const float>& result, const DiagnosisRows& out) noexcept {                  \
    diagnose_rows(conventions_of(conversion), count, in, result, out);                               \
  }                                                                                                  \
  constexpr WorkflowKernels NAME = {&to_specular_##SET, &to_metallic_##SET, &follow_##SET, &diagnose_##SET}

REMAP_WORKFLOW_KERNELS(baseline, kBaselineKernels, REMAP_FOR_BASELINE);
#if REMAP_HAS_X86_SETS
REMAP_WORKFLOW_KERNELS(avx2, kAvx2Kernels, REMAP_FOR_AVX2);
REMAP_WORKFLOW_KERNELS(avx512, kAvx512Kernels, REMAP_FOR_AVX512);
#endif

#undef REMAP_WORKFLOW_KERNELS

}  // namespace

const WorkflowKernels& workflow_kernels(InstructionSet set) {
#if REMAP_HAS_X86_SETS
  if (set == InstructionSet::kAvx512) return kAvx512Kernels;
  if (set == InstructionSet::kAvx2) return kAvx2Kernels;
#endif
  static_cast<void>(set);
  return kBaselineKernels;
}

}  // namespace remap
