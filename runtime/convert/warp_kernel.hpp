// Compiled warps over rows of texels, compiled once for each instruction set; every set gives the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "convert/instruction_set.hpp"
#include "model/warp.hpp"

namespace remap {

// A warp laid out for the pass: tables padded to whole vectors.
struct PackedWarp {
  std::size_t dimension = 0;
  std::size_t width_nodes = 0, nodes = 0;
  float least_alpha = 0.0f, largest_alpha = 0.0f;
  std::vector<float> diffuse;   // dimension x 4
  std::vector<float> specular;  // width_nodes x dimension x 4
  std::vector<float> entries;   // nodes^dimension x 8: parameters as they are
  std::array<float, kLargestWarpDimension> low{}, high{};
};

// `warp` must be valid (require_valid).
PackedWarp packed(const CompiledWarp& warp);

// Converts `count` texels: rows of diffuse (three), specular (three) and alpha, of the source and of the
// template; an output row may be exactly an input row. evaluate_warp() to 1e-4. Returns the number of texels
// with a value that is not in 0 to 1.
using WarpKernel = std::size_t (*)(const PackedWarp& warp, std::size_t count,
                                   const std::array<const float*, kWarpParameters>& in,
                                   const std::array<float*, kWarpParameters>& out) noexcept;

// For `set`, which the processor must have.
WarpKernel warp_kernel(InstructionSet set);

}  // namespace remap
