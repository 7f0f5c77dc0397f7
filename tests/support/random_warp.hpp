// This file makes a warp with random numbers, as a registration could have made it.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "remap/warp.hpp"

namespace remap {

class WarpDraw {
 public:
  explicit WarpDraw(unsigned seed) : engine_(seed) {}
  float number(float low, float high) {
    return low + (high - low) * static_cast<float>(engine_() >> 8) * 0x1p-24f;
  }
  std::vector<float> numbers(std::size_t count, float low, float high) {
    std::vector<float> drawn(count);
    for (float& value : drawn) value = number(low, high);
    return drawn;
  }
  std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(engine_()) % end; }

 private:
  std::mt19937 engine_;
};

inline SeparableTerms random_separable(WarpDraw* draw, std::size_t dimension) {
  constexpr std::size_t kNodes = 16;
  SeparableTerms terms;
  terms.diffuse = draw->numbers(3 * dimension, -2.0f, 2.0f);
  terms.specular = draw->numbers(3 * dimension * kNodes, -2.0f, 2.0f);
  terms.offset = draw->numbers(dimension * kNodes, -1.0f, 1.0f);
  return terms;
}

inline QuadraticTerms random_quadratic(WarpDraw* draw, std::size_t dimension) {
  QuadraticTerms terms;
  terms.weights = draw->numbers(dimension * kQuadraticTerms, -0.5f, 0.5f);
  return terms;
}

inline BlendedNodes random_blended(WarpDraw* draw, std::size_t count) {
  BlendedNodes entries;
  for (std::size_t p = 0; p < kWarpParameters; ++p) {
    entries.least[p] = draw->number(0.0f, 0.1f);
    entries.largest[p] = draw->number(0.5f, 1.0f);
  }
  entries.codes.resize(count * kWarpParameters);
  for (std::uint8_t& code : entries.codes) code = static_cast<std::uint8_t>(draw->below(256));
  return entries;
}

inline CopiedNodes random_copied(WarpDraw* draw, std::size_t count) {
  CopiedNodes entries;
  entries.palette.resize(count / 2 + 1);
  for (WarpTexel& texel : entries.palette)
    for (float& value : texel) value = draw->number(0.0f, 1.0f);
  entries.indices.resize(count);
  for (std::uint16_t& index : entries.indices)
    index = static_cast<std::uint16_t>(draw->below(static_cast<std::uint32_t>(entries.palette.size())));
  return entries;
}

// A WarpShape is either kind of coordinates and of table.
struct WarpShape {
  std::size_t dimension = 2;
  bool quadratic = false, copied = false;
};

inline CompiledWarp random_warp(const WarpShape& shape, unsigned seed, std::size_t nodes = 9) {
  WarpDraw draw(seed);
  CompiledWarp warp;
  AppearanceCoordinates& space = warp.coordinates;
  space.dimension = shape.dimension;
  space.least_alpha = 0.04f;
  space.largest_alpha = 1.0f;
  if (shape.quadratic)
    space.terms = random_quadratic(&draw, shape.dimension);
  else
    space.terms = random_separable(&draw, shape.dimension);
  ParameterTable& table = warp.table;
  table.nodes = nodes;
  std::size_t count = 1;
  for (std::size_t k = 0; k < shape.dimension; ++k) {
    count *= nodes;
    table.low.push_back(draw.number(-3.0f, -1.0f));
    table.high.push_back(draw.number(1.0f, 3.0f));
  }
  if (shape.copied)
    table.entries = random_copied(&draw, count);
  else
    table.entries = random_blended(&draw, count);
  return warp;
}

inline CompiledWarp random_warp(std::size_t dimension, unsigned seed, std::size_t nodes = 9) {
  return random_warp(WarpShape{dimension, false, false}, seed, nodes);
}

}  // namespace remap
