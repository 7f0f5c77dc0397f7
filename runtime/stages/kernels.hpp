// This file declares the loops over texels, which are compiled once for each instruction set. Every
// instruction set gives the same bits as the generated headers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "converter/compact_form.hpp"
#include "remap/converter.hpp"
#include "remap/model.hpp"
#include "stages/packed_warp.hpp"
#include "stages/workflow_conventions.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#define REMAP_HAS_X86_SETS 1
#else
#define REMAP_HAS_X86_SETS 0
#endif

namespace remap {

// A FormPass holds the arguments of a kernel that depend on the converter (converter/compact_form.hpp).
struct FormPass {
  using Terms = std::array<std::array<float, kMostPowersOfAlpha>, kMostPowersOfT>;
  RoughnessEncoding source = RoughnessEncoding::kAlpha;
  RoughnessEncoding target = RoughnessEncoding::kAlpha;
  float width_min = 0.0f, width_max = 0.0f;    // the domain, in the width parameter of the source
  float width_from = 0.0f, width_to = 0.0f;    // widths are clamped to this range
  float alpha_min = 0.0f, least_alpha = 0.0f;  // least alpha of the source's domain, and of the target
  float specular_min = 0.0f, specular_max = 0.0f;
  float pole = 1.0f;
  float alpha_limit = 0.0f, specular_limit = 0.0f;  // infinite if there is no limit
  float turn = 0.0f, turn_by_alpha = 0.0f, bend = 0.0f, spread = 0.0f;
  std::size_t powers = 1, terms = 1;  // number of terms in both factors; the rest is zeros
  Terms alpha_terms{}, specular_terms{};
};

// A TexelRows holds rows of `count` texels. An output row may be the same memory as its input row.
struct TexelRows {
  std::size_t count = 0;
  std::size_t channels = 1;  // 1 or 3
  const float* roughness = nullptr;
  std::array<const float*, 3> specular{};
  float* roughness_out = nullptr;
  std::array<float*, 3> specular_out{};
  std::uint8_t* outside = nullptr;  // 1 for each texel out of domain, otherwise 0; may be null
};

// These are the rows of both workflows. SpecularRows has diffuse, specular and width, MetallicRows has base
// color, metallic and width.
template <typename Float>
using SpecularRows = std::array<Float*, 7>;
template <typename Float>
using MetallicRows = std::array<Float*, 5>;

// A DiagnosisRows holds the diagnosis of a conversion to metallic, in rows of `count` texels each.
struct DiagnosisRows {
  float* residual = nullptr;
  float* metallic_uncertainty = nullptr;
  float* issues = nullptr;  // sums of MetallicIssue, divided by 255
};

// Kernels take rows of any length. An output row may be the same memory as the input row of the same
// parameter.
struct Kernels {
  // Converts by a compact form. Returns the number of texels out of domain.
  std::size_t (*convert)(const FormPass& pass, const TexelRows& rows) noexcept;

  // Convert from metallic to specular by equation (2), and from specular to metallic by the projection.
  void (*to_specular)(const workflow_code::Conventions& use, std::size_t count,
                      const MetallicRows<const float>& in, const SpecularRows<float>& out) noexcept;
  void (*project)(const workflow_code::Conventions& use, float prior, std::size_t count,
                  const SpecularRows<const float>& in, const MetallicRows<float>& out) noexcept;
  // Replaces base color and metallic in `result`. Several values of metallic give pictures that differ by
  // less than a step of 8 bits from the best picture. Of these, it takes the value closest to `wanted`, and
  // the best base color for this value. Texels whose `wanted` is NaN stay unchanged.
  void (*follow)(const workflow_code::Conventions& use, std::size_t count,
                 const SpecularRows<const float>& in, const float* wanted,
                 const MetallicRows<float>& result) noexcept;
  // Writes residual, uncertainty of metallic, and issues of each texel. If the material or the result has
  // NaN, the first two are NaN and there are no issues.
  void (*diagnose)(const workflow_code::Conventions& use, std::size_t count,
                   const SpecularRows<const float>& in, const MetallicRows<const float>& result,
                   const DiagnosisRows& out) noexcept;

  // Converts by a compiled warp: rows of diffuse (three), specular (three) and alpha, from source to
  // template. Agrees with evaluate_warp() to 1e-4. Returns the number of texels with a value outside 0 to 1.
  std::size_t (*warp)(const PackedWarp& warp, std::size_t count,
                      const std::array<const float*, kWarpParameters>& in,
                      const std::array<float*, kWarpParameters>& out) noexcept;
};

// Returns the kernels for `set`, which the processor must support.
const Kernels& kernels(InstructionSet set);

}  // namespace remap
