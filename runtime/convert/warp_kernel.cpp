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

inline code::WidthScale width_of(const PackedWarp& warp) noexcept {
  return {warp.least_alpha, warp.largest_alpha, warp.width_start, warp.width_scale};
}

template <std::size_t kDimension>
inline code::SeparableView<kDimension> view_of(const PackedWarp& warp,
                                               const PackedSeparable& terms) noexcept {
  return {terms.diffuse.data(), terms.width_nodes.data(), terms.last_width, width_of(warp)};
}

template <std::size_t kDimension>
inline code::QuadraticView<kDimension> view_of(const PackedWarp& warp,
                                               const PackedQuadratic& terms) noexcept {
  return {terms.weights.data(), width_of(warp)};
}

template <std::size_t kDimension>
inline code::NodeGrid<kDimension> grid_of(const PackedWarp& warp) noexcept {
  code::NodeGrid<kDimension> grid{};
  grid.nodes = warp.nodes;
  for (std::size_t k = 0; k < kDimension; ++k) {
    grid.low[k] = warp.low[k];
    grid.scale[k] = warp.scale[k];
  }
  return grid;
}

template <std::size_t kDimension>
inline code::BlendedView<kDimension> view_of(const PackedWarp& warp, const PackedBlended& table) noexcept {
  return {grid_of<kDimension>(warp), table.entries.data()};
}

template <std::size_t kDimension>
inline code::CopiedView<kDimension> view_of(const PackedWarp& warp, const PackedCopied& table) noexcept {
  return {grid_of<kDimension>(warp), table.indices.data(), table.palette.data()};
}

// Coordinates and table of whatever kind; which, is asked once a block. Code for each pair of kinds would
// take twice as long to compile and be no faster.
template <std::size_t kDimension>
struct AnyCoordinates {
  bool separable = false;
  code::SeparableView<kDimension> by_separable{};
  code::QuadraticView<kDimension> by_quadratic{};
};
template <std::size_t kDimension>
struct AnyTable {
  bool blended = false;
  code::BlendedView<kDimension> by_blended{};
  code::CopiedView<kDimension> by_copied{};
};

template <std::size_t kDimension>
inline void locate(const AnyCoordinates<kDimension>& use,
                   const code::HeldBlock<kWarpParameters, code::kWarpBlock>& held,
                   code::Positions<kDimension>& position) noexcept {
  if (use.separable)
    code::locate(use.by_separable, held, position);
  else
    code::locate(use.by_quadratic, held, position);
}

template <std::size_t kDimension>
inline void look_up(const AnyTable<kDimension>& use, const code::Positions<kDimension>& position,
                    code::TexelLanes<code::kEntryLanes>& found) noexcept {
  if (use.blended)
    code::look_up(use.by_blended, position, found);
  else
    code::look_up(use.by_copied, position, found);
}

template <std::size_t kDimension>
inline AnyCoordinates<kDimension> coordinates_of(const PackedWarp& warp) noexcept {
  AnyCoordinates<kDimension> any;
  if (const auto* separable = std::get_if<PackedSeparable>(&warp.coordinates)) {
    any.separable = true;
    any.by_separable = view_of<kDimension>(warp, *separable);
  } else {
    any.by_quadratic = view_of<kDimension>(warp, *std::get_if<PackedQuadratic>(&warp.coordinates));
  }
  return any;
}

template <std::size_t kDimension>
inline AnyTable<kDimension> table_of(const PackedWarp& warp) noexcept {
  AnyTable<kDimension> any;
  if (const auto* blended = std::get_if<PackedBlended>(&warp.table)) {
    any.blended = true;
    any.by_blended = view_of<kDimension>(warp, *blended);
  } else {
    any.by_copied = view_of<kDimension>(warp, *std::get_if<PackedCopied>(&warp.table));
  }
  return any;
}

template <std::size_t kDimension>
inline std::size_t convert_in(const PackedWarp& warp, std::size_t count, const Sources& in,
                              const Targets& out) noexcept {
  const auto coordinates = coordinates_of<kDimension>(warp);
  const auto table = table_of<kDimension>(warp);
  return code::convert_rows<code::kWarpBlock>(count, in, out, [&](const auto& from, const auto& to) {
    return code::warp_block<kDimension>(coordinates, table, from, to);
  });
}

inline std::size_t convert(const PackedWarp& warp, std::size_t count, const Sources& in,
                           const Targets& out) noexcept {
  if (warp.dimension == 1) return convert_in<1>(warp, count, in, out);
  if (warp.dimension == 2) return convert_in<2>(warp, count, in, out);
  return convert_in<3>(warp, count, in, out);
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

WarpKernel warp_kernel(InstructionSet set) {
#if REMAP_HAS_X86_SETS
  if (set == InstructionSet::kAvx512) return &convert_avx512;
  if (set == InstructionSet::kAvx2) return &convert_avx2;
#endif
  static_cast<void>(set);
  return &convert_baseline;
}

}  // namespace remap
