// The wrappers that make compilers build every generated header for every instruction set. Compiled once for
// each REMAP_KERNEL_SHARD below kKernelShards, every time for other headers: those of one compilation take a
// fraction of a second each for each set.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <utility>

#include "convert/compiled_kernels.hpp"
#include "convert/instruction_target.hpp"

// The standard headers that registry.hpp asks for stand above: they are none of these functions.
REMAP_INLINED_FUNCTIONS_BEGIN
#include "registry.hpp"
REMAP_INLINED_FUNCTIONS_END

namespace remap {
namespace {

template <typename Converter, std::size_t Channels>
REMAP_FOR_BASELINE std::size_t convert(std::size_t count, const float* roughness,
                                       const std::array<const float*, Channels>& specular,
                                       float* roughness_out,
                                       const std::array<float*, Channels>& specular_out) noexcept {
  return Converter::evaluate_batch(count, roughness, specular, roughness_out, specular_out);
}

#if REMAP_HAS_X86_SETS
template <typename Converter, std::size_t Channels>
REMAP_FOR_AVX2 std::size_t convert_avx2(std::size_t count, const float* roughness,
                                        const std::array<const float*, Channels>& specular,
                                        float* roughness_out,
                                        const std::array<float*, Channels>& specular_out) noexcept {
  return Converter::evaluate_batch(count, roughness, specular, roughness_out, specular_out);
}

template <typename Converter, std::size_t Channels>
REMAP_FOR_AVX512 std::size_t convert_avx512(std::size_t count, const float* roughness,
                                            const std::array<const float*, Channels>& specular,
                                            float* roughness_out,
                                            const std::array<float*, Channels>& specular_out) noexcept {
  return Converter::evaluate_batch(count, roughness, specular, roughness_out, specular_out);
}
#endif

template <std::size_t Count>
using Table = std::array<CompiledKernels, Count>;

template <typename... Converters>
std::span<const CompiledKernels> kernels(InstructionSet set, ConverterList<Converters...>) {
  static constexpr Table<sizeof...(Converters)> kBaseline = {
      {{&convert<Converters, 1>, &convert<Converters, 3>}...}};
#if REMAP_HAS_X86_SETS
  static constexpr Table<sizeof...(Converters)> kAvx2 = {
      {{&convert_avx2<Converters, 1>, &convert_avx2<Converters, 3>}...}};
  static constexpr Table<sizeof...(Converters)> kAvx512 = {
      {{&convert_avx512<Converters, 1>, &convert_avx512<Converters, 3>}...}};
  if (set == InstructionSet::kAvx512) return kAvx512;
  if (set == InstructionSet::kAvx2) return kAvx2;
#endif
  static_cast<void>(set);
  return kBaseline;
}

constexpr std::size_t kShard = REMAP_KERNEL_SHARD;

// Every kKernelShards-th converter, from kShard.
template <typename... Converters>
auto converters_of_shard(ConverterList<Converters...>) {
  constexpr std::size_t kAll = sizeof...(Converters);
  constexpr std::size_t kCount = (kAll + kKernelShards - 1 - kShard) / kKernelShards;
  return []<std::size_t... I>(std::index_sequence<I...>) {
    using All = std::tuple<Converters...>;
    return ConverterList<std::tuple_element_t<kShard + I * kKernelShards, All>...>{};
  }
  (std::make_index_sequence<kCount>{});
}

}  // namespace

template <std::size_t Shard>
std::span<const CompiledKernels> KernelShard<Shard>::kernels(InstructionSet set) {
  return remap::kernels(set, converters_of_shard(ConverterTypes{}));
}

template struct KernelShard<kShard>;

}  // namespace remap
