// Converts materials from one workflow to the other in memory. Closed forms use floats, with the same bits as
// the generated header of the conversion if products and sums are not fused. Networks are interpreted in
// double precision, to test their headers.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "remap/workflow.hpp"

namespace remap {

// One texel; colors linear, all values 0 to 1. `width` is the workflow's own parameter.
struct SpecularMaterial {
  std::array<float, 3> diffuse{}, specular{};
  float width = 0.0f;
};
struct MetallicMaterial {
  std::array<float, 3> base_color{};
  float metallic = 0.0f;
  float width = 0.0f;
};

// Converts `count` texels. `in` and `out`: one row per channel, in the order of source_parameters() and
// target_parameters(). An output row may equal an input row; other rows must not overlap. Values outside [0,
// 1] are clamped; NaN makes the outputs that depend on it NaN. Returns the number of texels with such values.
// Throws kUsage for a wrong number of rows, and the errors of require_valid().
std::size_t convert_workflow(const WorkflowConversion& conversion, std::size_t count,
                             std::span<const float* const> in, std::span<float* const> out);

// Converts one texel. Throws kUsage for a conversion in the other direction.
MetallicMaterial to_metallic(const WorkflowConversion& conversion, const SpecularMaterial& material);
SpecularMaterial to_specular(const WorkflowConversion& conversion, const MetallicMaterial& material);

}  // namespace remap
