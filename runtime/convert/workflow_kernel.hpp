// The formulas of workflow conversions over rows of texels, compiled once for each instruction set; every set
// gives the same bits, which are those of convert_workflow() and of generated headers.
#pragma once

#include <array>
#include <cstddef>

#include "remap/converter.hpp"
#include "remap/workflow.hpp"

namespace remap {

// Rows of the two workflows: diffuse, specular, width; base color, metallic, width.
template <typename Float>
using SpecularRows = std::array<Float*, 7>;
template <typename Float>
using MetallicRows = std::array<Float*, 5>;

// What is found out about a conversion to metallic; rows of `count` texels each.
struct DiagnosisRows {
  float* residual = nullptr;
  float* metallic_width = nullptr;
  float* doubts = nullptr;  // sums of Doubt, over 255
};

// Which texels follow another metallic: all, or those where it is a guess (kGuessWidth).
enum class FollowedTexels { kAll, kGuesses };

// `conversion` must be valid (require_valid). Rows as in convert_workflow.
struct WorkflowKernels {
  // By equation (2).
  void (*to_specular)(const WorkflowConversion& conversion, std::size_t count,
                      const MetallicRows<const float>& in, const SpecularRows<float>& out) noexcept;
  // By the conversion's formula.
  void (*to_metallic)(const WorkflowConversion& conversion, std::size_t count,
                      const SpecularRows<const float>& in, const MetallicRows<float>& out) noexcept;
  // Of those metallic values whose pictures are within a step of 8 bits of the best, the nearest to
  // `wanted`, with the base color that is best for it: replaces base color and metallic in `result`.
  // Texels whose `wanted` is NaN stay, and with kGuesses those whose metallic is none.
  void (*follow)(const WorkflowConversion& conversion, std::size_t count, const SpecularRows<const float>& in,
                 const float* wanted, FollowedTexels which, const MetallicRows<float>& result) noexcept;
  // What diagnose() says of each texel. NaN in the material or in the result: residual and width NaN, no
  // doubt.
  void (*diagnose)(const WorkflowConversion& conversion, std::size_t count,
                   const SpecularRows<const float>& in, const MetallicRows<const float>& result,
                   const DiagnosisRows& out) noexcept;
};

// For `set`, which the processor must have.
const WorkflowKernels& workflow_kernels(InstructionSet set);

}  // namespace remap
