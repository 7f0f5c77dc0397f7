// The loops over texels, compiled once for each instruction set. Every set gives the same bits, which are
// those of generated headers.
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

// The arguments of a kernel that depend on the converter (converter/compact_form.hpp).
struct FormPass {
  using Terms = std::array<std::array<float, kMostPowersOfAlpha>, kMostPowersOfT>;
  RoughnessEncoding source = RoughnessEncoding::kAlpha;
  RoughnessEncoding target = RoughnessEncoding::kAlpha;
  float width_min = 0.0f, width_max = 0.0f;    // the domain, in the source's own width parameter
  float width_from = 0.0f, width_to = 0.0f;    // to which widths are clamped
  float alpha_min = 0.0f, least_alpha = 0.0f;  // of the source in the domain; of the target
  float specular_min = 0.0f, specular_max = 0.0f;
  float pole = 1.0f;
  float alpha_limit = 0.0f, specular_limit = 0.0f;  // infinite where there is none
  float turn = 0.0f, turn_by_alpha = 0.0f, bend = 0.0f, spread = 0.0f;
  std::size_t powers = 1, terms = 1;  // of both factors, which are padded with zeros
  Terms alpha_terms{}, specular_terms{};
};

// Rows of `count` texels. An output row may be exactly its input row.
struct TexelRows {
  std::size_t count = 0;
  std::size_t channels = 1;  // 1 or 3
  const float* roughness = nullptr;
  std::array<const float*, 3> specular{};
  float* roughness_out = nullptr;
  std::array<float*, 3> specular_out{};
  std::uint8_t* outside = nullptr;  // 1 for each texel out of domain, else 0; null: nobody asks
};

// Rows of the two workflows: diffuse, specular, width; base color, metallic, width.
template <typename Float>
using SpecularRows = std::array<Float*, 7>;
template <typename Float>
using MetallicRows = std::array<Float*, 5>;

// The diagnosis of a conversion to metallic; rows of `count` texels each.
struct DiagnosisRows {
  float* residual = nullptr;
  float* metallic_uncertainty = nullptr;
  float* issues = nullptr;  // sums of MetallicIssue, over 255
};

// Kernels take rows of any length. An output row may be exactly the input row of the same parameter.
struct Kernels {
  // By a compact form. Returns the number of texels out of domain.
  std::size_t (*convert)(const FormPass& pass, const TexelRows& rows) noexcept;

  // From metallic to specular by equation (2), and back by the projection.
  void (*to_specular)(const workflow_code::Conventions& use, std::size_t count,
                      const MetallicRows<const float>& in, const SpecularRows<float>& out) noexcept;
  void (*project)(const workflow_code::Conventions& use, float prior, std::size_t count,
                  const SpecularRows<const float>& in, const MetallicRows<float>& out) noexcept;
  // Of those metallic values whose pictures are within a step of 8 bits of the best, the nearest to `wanted`,
  // with the base color that is best for it: replaces base color and metallic in `result`. Texels whose
  // `wanted` is NaN stay.
  void (*follow)(const workflow_code::Conventions& use, std::size_t count,
                 const SpecularRows<const float>& in, const float* wanted,
                 const MetallicRows<float>& result) noexcept;
  // Residual, width and issues of each texel. NaN in the material or in the result: residual and width NaN,
  // no doubt.
  void (*diagnose)(const workflow_code::Conventions& use, std::size_t count,
                   const SpecularRows<const float>& in, const MetallicRows<const float>& result,
                   const DiagnosisRows& out) noexcept;

  // By a compiled warp: rows of diffuse (three), specular (three) and alpha, of the source and of the
  // template. evaluate_warp() to 1e-4. Returns the number of texels with a value that is not in 0 to 1.
  std::size_t (*warp)(const PackedWarp& warp, std::size_t count,
                      const std::array<const float*, kWarpParameters>& in,
                      const std::array<float*, kWarpParameters>& out) noexcept;
};

// For `set`, which the processor must have.
const Kernels& kernels(InstructionSet set);

}  // namespace remap
