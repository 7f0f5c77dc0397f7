// Synthetic pairs of materials with a known result. Both materials are nonlinear, monotone functions of the
// same latent variables in different patterns, so that each source texel has one correct template
// reflectance.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "study/warp_case.hpp"

namespace remapc {

using Latents = std::vector<std::array<double, 3>>;

// A case of width and height `size`. The truth is the template's reflectance at the source's latents.
struct WarpSet : WarpCase {
  Latents source_latents, target_latents;
};

// `leaf`: age and stem. `wood`: grain and wear. `rust`: rust, grime and polish.
WarpSet leaf_set(std::size_t size);
WarpSet wood_set(std::size_t size);
WarpSet rust_set(std::size_t size);

// Draws thin straight lines in each region, clipped to the region: three, or more until they cover 80 texels.
// They differ between the materials and the seeds.
std::vector<StrokePair> strokes_of(const WarpSet& set, std::uint32_t seed);

// The names of the sets: `leaf`, `wood`, `rust`.
std::vector<std::string> builtin_warp_names();

// Returns the sets of `names` (all if empty) with `size` x `size` texels and `stroke_sets` sets of strokes
// each. Throws kUsage unless `size` is 32 to 2048 and `stroke_sets` 1 to 100.
std::vector<WarpCase> builtin_warp_cases(std::size_t size, std::size_t stroke_sets,
                                         const std::vector<std::string>& names = {});

}  // namespace remapc
