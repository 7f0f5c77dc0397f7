// The generated headers, compiled once for each instruction set.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "convert/instruction_set.hpp"

namespace remap {

template <std::size_t Channels>
using CompiledKernel = std::size_t (*)(std::size_t count, const float* roughness,
                                       const std::array<const float*, Channels>& specular,
                                       float* roughness_out,
                                       const std::array<float*, Channels>& specular_out) noexcept;

// evaluate_batch of one header.
struct CompiledKernels {
  CompiledKernel<1> grey = nullptr;
  CompiledKernel<3> rgb = nullptr;
};

// For `set`, which the processor must have: one entry a converter, in the order of kConverters.
std::vector<CompiledKernels> compiled_kernels(InstructionSet set);

// Headers are compiled in this many parts, so that compilers work side by side.
inline constexpr std::size_t kKernelShards = REMAP_KERNEL_SHARDS;

// The part of converters `Shard`, `Shard` + kKernelShards and so on; in kernel_shard.cpp.
template <std::size_t Shard>
struct KernelShard {
  static std::span<const CompiledKernels> kernels(InstructionSet set);
};

}  // namespace remap
