#include "convert/warp_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "convert/instruction_target.hpp"

// The standard headers that it asks for stand above: they are none of these functions.
REMAP_INLINED_FUNCTIONS_BEGIN
#include "warp/warp_code.hpp"
REMAP_INLINED_FUNCTIONS_END

namespace remap {
namespace {

namespace code = warp_code;

using Sources = std::array<const float*, kWarpParameters>;
using Targets = std::array<float*, kWarpParameters>;

REMAP_INLINED_FUNCTIONS_BEGIN

template <std::size_t kDimension>
inline code::WarpView<kDimension> view_of(const PackedWarp& warp) noexcept {
  code::WarpView<kDimension> view{};
  view.diffuse = warp.diffuse.data();
  view.width_nodes = warp.specular.data();
  view.entries = warp.entries.data();
  view.last_width = static_cast<std::int32_t>(warp.width_nodes) - 2;
  view.nodes = static_cast<std::int32_t>(warp.nodes);
  view.least_alpha = warp.least_alpha;
  view.largest_alpha = warp.largest_alpha;
  view.width_scale = static_cast<float>(warp.width_nodes - 1) /
                     (code::binary_logarithm(warp.largest_alpha) - code::binary_logarithm(warp.least_alpha));
  for (std::size_t k = 0; k < kDimension; ++k) {
    view.low[k] = warp.low[k];
    view.scale[k] = static_cast<float>(warp.nodes - 1) / (warp.high[k] - warp.low[k]);
  }
  return view;
}

template <std::size_t kDimension>
inline std::size_t convert_by(const PackedWarp& warp, std::size_t count, const Sources& in,
                              const Targets& out) noexcept {
  const code::WarpView<kDimension> view = view_of<kDimension>(warp);
  return code::convert_rows<code::kWarpBlock>(count, in, out, [&](const auto& from, const auto& to) {
    return code::warp_block<kDimension>(view, from, to);
  });
}

inline std::size_t convert(const PackedWarp& warp, std::size_t count, const Sources& in,
                           const Targets& out) noexcept {
  if (warp.dimension == 1) return convert_by<1>(warp, count, in, out);
  if (warp.dimension == 2) return convert_by<2>(warp, count, in, out);
  return convert_by<3>(warp, count, in, out);
}

REMAP_INLINED_FUNCTIONS_END

#define REMAP_WARP_KERNEL(NAME, REMAP_TARGET)                                                 \
  REMAP_TARGET std::size_t NAME(const PackedWarp& warp, std::size_t count, const Sources& in, \
                                const Targets& out) noexcept {                                \
    return convert(warp, count, in, out);                                                     \
  }

REMAP_WARP_KERNEL(convert_baseline, REMAP_FOR_BASELINE)
#if REMAP_HAS_X86_SETS
REMAP_WARP_KERNEL(convert_avx2, REMAP_FOR_AVX2)
REMAP_WARP_KERNEL(convert_avx512, REMAP_FOR_AVX512)
#endif

#undef REMAP_WARP_KERNEL

}  // namespace

PackedWarp packed(const CompiledWarp& warp) {
  const AppearanceCoordinates& space = warp.coordinates;
  const auto& terms = std::get<SeparableTerms>(space.terms);
  const ParameterTable& table = warp.table;
  const std::size_t n = space.dimension, width_nodes = width_node_count(space, terms);
  PackedWarp result;
  result.dimension = n;
  result.width_nodes = width_nodes;
  result.nodes = table.nodes;
  result.least_alpha = space.least_alpha;
  result.largest_alpha = space.largest_alpha;
  result.diffuse.resize(4 * n);
  result.specular.resize(width_nodes * n * 4);
  for (std::size_t k = 0; k < n; ++k) std::copy_n(&terms.diffuse[3 * k], 3, &result.diffuse[4 * k]);
  for (std::size_t i = 0; i < width_nodes * n; ++i) {
    std::copy_n(&terms.specular[3 * i], 3, &result.specular[4 * i]);
    result.specular[4 * i + 3] = terms.offset[i];
  }
  const std::size_t entries = table.codes.size() / kWarpParameters;
  result.entries.resize(entries * code::kWarpLanes);
  for (std::size_t i = 0; i < entries; ++i)
    for (std::size_t p = 0; p < kWarpParameters; ++p)
      result.entries[i * code::kWarpLanes + p] = decoded(table, p, table.codes[i * kWarpParameters + p]);
  std::copy(table.low.begin(), table.low.end(), result.low.begin());
  std::copy(table.high.begin(), table.high.end(), result.high.begin());
  return result;
}

WarpKernel warp_kernel(InstructionSet set) {
#if REMAP_HAS_X86_SETS
  if (set == InstructionSet::kAvx512) return &convert_avx512;
  if (set == InstructionSet::kAvx2) return &convert_avx2;
#endif
  static_cast<void>(set);
  return &convert_baseline;
}

}  // namespace remap
