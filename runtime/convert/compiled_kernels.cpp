#include "convert/compiled_kernels.hpp"

#include <utility>

namespace remap {
namespace {

template <std::size_t... Shard>
std::vector<CompiledKernels> gathered(InstructionSet set, std::index_sequence<Shard...>) {
  const std::array<std::span<const CompiledKernels>, kKernelShards> shards = {
      KernelShard<Shard>::kernels(set)...};
  std::size_t count = 0;
  for (const auto& shard : shards) count += shard.size();
  std::vector<CompiledKernels> kernels;
  for (std::size_t i = 0; i < count; ++i) kernels.push_back(shards[i % kKernelShards][i / kKernelShards]);
  return kernels;
}

}  // namespace

std::vector<CompiledKernels> compiled_kernels(InstructionSet set) {
  return gathered(set, std::make_index_sequence<kKernelShards>{});
}

}  // namespace remap
