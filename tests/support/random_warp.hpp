// A warp with numbers drawn at random, as a registration could have made it.
#pragma once

#include <random>

#include "model/warp.hpp"

namespace remap {

inline CompiledWarp random_warp(std::size_t dimension, unsigned seed, std::size_t nodes = 9) {
  std::mt19937 engine(seed);
  const auto number = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(engine() >> 8) * 0x1p-24f;
  };
  CompiledWarp warp;
  AppearanceCoordinates& space = warp.coordinates;
  space.dimension = dimension;
  space.least_alpha = 0.04f;
  space.largest_alpha = 1.0f;
  constexpr std::size_t kNodes = 16;
  SeparableTerms terms;
  for (std::size_t i = 0; i < 3 * dimension; ++i) terms.diffuse.push_back(number(-2.0f, 2.0f));
  for (std::size_t i = 0; i < 3 * dimension * kNodes; ++i) terms.specular.push_back(number(-2.0f, 2.0f));
  for (std::size_t i = 0; i < dimension * kNodes; ++i) terms.offset.push_back(number(-1.0f, 1.0f));
  space.terms = std::move(terms);
  ParameterTable& table = warp.table;
  table.nodes = nodes;
  std::size_t entries = 1;
  for (std::size_t k = 0; k < dimension; ++k) {
    entries *= nodes;
    table.low.push_back(number(-3.0f, -1.0f));
    table.high.push_back(number(1.0f, 3.0f));
  }
  for (std::size_t p = 0; p < kWarpParameters; ++p) {
    table.least[p] = number(0.0f, 0.1f);
    table.largest[p] = number(0.5f, 1.0f);
  }
  for (std::size_t i = 0; i < entries * kWarpParameters; ++i)
    table.codes.push_back(static_cast<std::uint8_t>(engine() >> 24));
  return warp;
}

}  // namespace remap
