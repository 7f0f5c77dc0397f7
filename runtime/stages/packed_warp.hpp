// This file holds the memory layout of a compiled warp for warp/code. Generated headers contain the same
// numbers, so that both give the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "remap/warp.hpp"

namespace remap {

struct PackedSeparable {
  std::vector<float> diffuse;      // 3 x 4: for each dimension, the weights of the channels, then 0
  std::vector<float> width_nodes;  // nodes of alpha x 4 x 4: weights of specular, then offsets
  std::int32_t last_width = 0;     // index of the last but one node of alpha
};

struct PackedQuadratic {
  std::vector<float> weights;  // 36 weights for each dimension
};

struct PackedBlended {
  std::vector<float> entries;  // nodes x 8: 7 decoded parameters, then 0
};

struct PackedCopied {
  std::vector<std::uint16_t> indices;
  std::vector<float> palette;  // 7 parameters for each texel, then one 0
};

struct PackedWarp {
  std::size_t dimension = 0;
  float least_alpha = 0.0f, largest_alpha = 0.0f;
  float width_start = 0.0f, width_scale = 0.0f;  // position of alpha: (log2(alpha) - start) * scale
  std::variant<PackedSeparable, PackedQuadratic> coordinates;
  std::int32_t nodes = 0;                                   // nodes of the table along each dimension
  std::array<float, kLargestWarpDimension> low{}, scale{};  // position between nodes: (x - low) * scale
  std::variant<PackedBlended, PackedCopied> table;
};

// Packs `warp`, which must be valid (require_valid).
PackedWarp packed(const CompiledWarp& warp);

}  // namespace remap
