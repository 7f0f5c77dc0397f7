// This file holds the memory layout of a compiled warp for stages/code. Generated headers contain the same
// numbers, so that both give the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "remap/warp.hpp"

namespace remap {

// A PackedWarp has one of two kinds of coordinates and one of two kinds of tables. Arrays of the other kinds
// are empty.
struct PackedWarp {
  std::size_t dimension = 0;
  float least_alpha = 0.0f, largest_alpha = 0.0f;
  float width_start = 0.0f, width_scale = 0.0f;  // position of alpha: (log2(alpha) - start) * scale
  // Separable coordinates.
  std::vector<float> diffuse;      // 3 x 4: for each dimension, the weights of the channels, then 0
  std::vector<float> width_nodes;  // nodes of alpha x 4 x 4: weights of specular, then offsets
  std::int32_t last_width = 0;     // index of the last but one node of alpha
  // Quadratic coordinates.
  std::vector<float> weights;  // 36 weights for each dimension

  std::int32_t nodes = 0;                                   // nodes of the table along each dimension
  std::array<float, kLargestWarpDimension> low{}, scale{};  // position between nodes: (x - low) * scale
  // This is the table of a warp that blends parameters between nodes.
  std::vector<float> entries;  // nodes x 8: 7 decoded parameters, then 0
  // These are the table of a warp that copies texels.
  std::vector<std::uint16_t> indices;
  std::vector<float> palette;  // 7 parameters for each texel, then one 0

  bool is_separable() const noexcept { return weights.empty(); }
  bool is_blended() const noexcept { return palette.empty(); }
};

// Packs `warp`, which must be valid (require_valid).
PackedWarp packed(const CompiledWarp& warp);

}  // namespace remap
