#include "stages/packed_warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__clang__)  // silences the warning about loops that cannot be vectorised
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wpass-failed"
#endif

namespace remap::warp_code {
// Each file depends on the files before it.
// clang-format off
#include "stages/code/bits.inc"
#include "stages/code/floats.inc"
#include "stages/code/rows.inc"
#include "stages/code/appearance.inc"
#include "stages/code/separable.inc"
#include "stages/code/quadratic.inc"
#include "stages/code/blended.inc"
#include "stages/code/copied.inc"
#include "stages/code/warp_block.inc"
// clang-format on
}  // namespace remap::warp_code

#if defined(__clang__)
#pragma clang diagnostic pop
#endif

namespace remap {
namespace {

// Every vector has this many values. If the warp has fewer dimensions, the rest are zeros.
constexpr std::size_t kLanes = 4;

void pack_terms(const AppearanceCoordinates& space, const SeparableTerms& terms, PackedWarp& result) {
  const std::size_t n = space.dimension, nodes = width_node_count(space, terms);
  result.last_width = static_cast<std::int32_t>(nodes) - 2;
  result.diffuse.resize(3 * kLanes);
  result.width_nodes.resize(nodes * 4 * kLanes);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      result.diffuse[c * kLanes + k] = terms.diffuse[3 * k + c];
      for (std::size_t i = 0; i < nodes; ++i)
        result.width_nodes[(4 * i + c) * kLanes + k] = terms.specular[3 * (i * n + k) + c];
    }
  for (std::size_t i = 0; i < nodes; ++i)
    std::copy_n(&terms.offset[i * n], n, &result.width_nodes[(4 * i + 3) * kLanes]);
}
void pack_terms(const AppearanceCoordinates&, const QuadraticTerms& terms, PackedWarp& result) {
  result.weights = terms.weights;
}

// Returns the number of steps from the least alpha to the largest alpha.
float width_places(const AppearanceCoordinates& space, const SeparableTerms& terms) {
  return static_cast<float>(width_node_count(space, terms) - 1);
}
float width_places(const AppearanceCoordinates&, const QuadraticTerms&) { return 1.0f; }

void pack_entries(const BlendedNodes& entries, PackedWarp& result) {
  const std::size_t nodes = entries.codes.size() / kWarpParameters;
  result.entries.resize(nodes * warp_code::kEntryLanes);
  warp_code::decode_entries(entries.codes.data(), nodes, entries.least.data(), entries.largest.data(),
                            result.entries.data());
}
void pack_entries(const CopiedNodes& entries, PackedWarp& result) {
  result.indices = entries.indices;
  result.palette.reserve(entries.palette.size() * kWarpParameters + 1);
  for (const WarpTexel& texel : entries.palette)
    result.palette.insert(result.palette.end(), texel.begin(), texel.end());
  result.palette.push_back(0.0f);
}

}  // namespace

PackedWarp packed(const CompiledWarp& warp) {
  const AppearanceCoordinates& space = warp.coordinates;
  const ParameterTable& table = warp.table;
  PackedWarp result;
  result.dimension = space.dimension;
  result.least_alpha = space.least_alpha;
  result.largest_alpha = space.largest_alpha;
  result.width_start = warp_code::binary_logarithm(space.least_alpha);
  const float widths = warp_code::binary_logarithm(space.largest_alpha) - result.width_start;
  std::visit(
      [&](const auto& terms) {
        result.width_scale = width_places(space, terms) / widths;
        pack_terms(space, terms, result);
      },
      space.terms);
  result.nodes = static_cast<std::int32_t>(table.nodes);
  for (std::size_t k = 0; k < result.dimension; ++k) {
    result.low[k] = table.low[k];
    result.scale[k] = static_cast<float>(table.nodes - 1) / (table.high[k] - table.low[k]);
  }
  std::visit([&](const auto& entries) { pack_entries(entries, result); }, table.entries);
  return result;
}

}  // namespace remap
