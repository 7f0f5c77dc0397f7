// Compiled warps over rows of texels, compiled once for each instruction set; every set gives the same bits.
#pragma once

#include <array>
#include <cstddef>

#include "remap/converter.hpp"
#include "warp/packed_warp.hpp"

namespace remap {

// Converts `count` texels: rows of diffuse (three), specular (three) and alpha, of the source and of the
// template; an output row may be exactly an input row. evaluate_warp() to 1e-4. Returns the number of texels
// with a value that is not in 0 to 1.
using WarpKernel = std::size_t (*)(const PackedWarp& warp, std::size_t count,
                                   const std::array<const float*, kWarpParameters>& in,
                                   const std::array<float*, kWarpParameters>& out) noexcept;

// For `set`, which the processor must have.
WarpKernel warp_kernel(InstructionSet set);

}  // namespace remap
