// This file makes synthetic pairs of materials with a known result. Both materials are nonlinear, monotone
// functions of the same latent variables in different patterns, so that each source texel has one correct
// template reflectance.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "warp/material.hpp"

namespace remap {

using Latents = std::vector<std::array<double, 3>>;

// A WarpSet holds maps of width and height `size`, row-major.
struct WarpSet {
  std::string name;
  std::size_t size = 0;
  WarpMaterial source, target;
  Latents source_latents, target_latents;
  std::vector<WarpTexel> truth;  // the template's reflectance at the source's latents
};

// `leaf` has age and stem; `rust` has rust, grime and polish.
WarpSet leaf_set(std::size_t size);
WarpSet rust_set(std::size_t size);

// Draws thin straight lines in each region, clipped to the region. There are three lines, or more until they
// cover 80 texels. They differ between the materials and the seeds.
std::vector<StrokePair> strokes_of(const WarpSet& set, std::uint32_t seed);

}  // namespace remap
