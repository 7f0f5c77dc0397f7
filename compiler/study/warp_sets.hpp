// Pairs of materials with a known answer: both are different nonlinear, monotone functions of the same
// latents, laid out in other patterns, so that each source texel has one right template reflectance.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "warp/space/material.hpp"

namespace remapc {

using Latents = std::vector<std::array<double, 3>>;

struct WarpSet {
  std::string name;
  std::size_t size = 0;  // texels along an edge
  WarpMaterial source, target;
  std::vector<remap::WarpTexel> truth;  // the template's reflectance at the source's latents
  Latents source_latents, target_latents;
};

// `leaf`: age and stem. `wood`: grain and wear. `rust`: rust, grime and polish.
WarpSet leaf_set(std::size_t size);
WarpSet wood_set(std::size_t size);
WarpSet rust_set(std::size_t size);

// Three thin straight scribbles a region, clipped to it, other ones in each material and for each `seed`.
std::vector<StrokePair> strokes_of(const WarpSet& set, std::uint32_t seed);

// Smooth noise with equal shares of all values in 0 to 1, `stretch` times as long along rows as across.
std::vector<double> ranked_noise(std::size_t size, double roughness, std::uint32_t seed,
                                 std::size_t stretch = 1);

}  // namespace remapc
