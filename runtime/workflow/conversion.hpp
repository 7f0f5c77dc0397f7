// Materials from one workflow to the other, in memory. Closed forms take floats throughout, and give bit for
// bit what the generated header of the same conversion gives where products and sums are not fused. Networks
// are interpreted in double precision: the oracle of their headers.
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

// `count` texels. `in` and `out`: one row of texels a channel, in the order of source_parameters() and
// target_parameters(); an output row may be exactly any input row, other rows may not overlap. Values beyond
// 0 to 1 are held there; NaN makes the outputs that depend on it NaN. Returns the number of texels that had
// such values. Throws kUsage for another number of rows, kInput for a conversion that require_valid()
// refuses.
std::size_t convert_workflow(const WorkflowConversion& conversion, std::size_t count,
                             std::span<const float* const> in, std::span<float* const> out);

// One texel. Throws kUsage for a conversion in the other direction.
MetallicMaterial to_metallic(const WorkflowConversion& conversion, const SpecularMaterial& material);
SpecularMaterial to_specular(const WorkflowConversion& conversion, const MetallicMaterial& material);

}  // namespace remap
