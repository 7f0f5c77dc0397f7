// This file holds the objective of a match: the lights of the pictures, the weights of pixels and mean, and
// sums over pixels.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "look/scene.hpp"
#include "remap/model.hpp"

namespace remap {

enum class Weighting {
  kUniform,   // L2 of linear radiance (the paper)
  kRelative,  // w = cos_view / (I / max(I) + floor), where I is the source picture
};

inline constexpr NamedValues<Weighting, 2> kWeightings = {
    {{Weighting::kUniform, "uniform"}, {Weighting::kRelative, "relative"}}};

// An Objective is minimised over the target's parameters. It is the sum over lights and pixels of w^2 (source
// - target)^2. With `mean_share`, each light adds mean_share * P * (mean(target) / mean(source) - 1)^2, where
// P is the sum of w^2 source^2 over its pixels. This term gives more weight to the energy of the lobe.
struct Objective {
  std::string name;  // name of a preset, or `custom`
  std::vector<Light> lights;
  Weighting weighting = Weighting::kRelative;
  double floor = 0.1;       // only for kRelative
  double mean_share = 0.0;  // only for kRelative

  // Returns the factor for the root of loss over power. With it, the error is relative to the power of the
  // pixels, without means.
  double error_factor() const { return compares_means() ? std::sqrt(1.0 + mean_share) : 1.0; }
  bool compares_means() const { return weighting == Weighting::kRelative && mean_share > 0.0; }
  bool operator==(const Objective&) const = default;
};

// Returns an objective by name. `paper` has a headlight and uniform weights, like the published table
// (Sztrajman et al. 2019, section 4.1). `natural-1` has a light at 60 degrees and relative weights.
// `natural-2` has a light at 65 degrees, relative weights, and a mean_share of 5. Under environments, its
// matches are closer to the best possible (docs/decisions/047). `natural` is the latest of these.
// Objective::name has the version. Throws kUsage for an unknown name.
Objective objective_preset(const std::string& name);
inline const std::vector<std::string> kObjectives = {"natural", "natural-1", "natural-2", "paper"};

// Returns the objective that a file names. In files, `natural` means `natural-1`, because older files were
// written before `natural-2` existed.
Objective recorded_objective(const std::string& name);

// A picture is black if no value is above this radiance.
inline constexpr float kBlackRadiance = 1e-12f;
bool is_black(std::span<const float> picture);

struct PictureWeights {
  std::vector<float> squared;      // w^2
  std::vector<std::size_t> means;  // indices of numbers that are means; all others are pixels
};

// Returns w^2 for the pictures of one source material. `source` holds one picture of `view_cosines.size()`
// pixels for each light. Each picture is followed by its mean if the objective compares means. max(I) is the
// maximum of one picture.
PictureWeights squared_weights(const Objective& objective, std::span<const float> source,
                               std::span<const float> view_cosines);

// The following functions sum over the pixels of pictures in double precision. They add to a fixed number of
// sums in a fixed order, so the result does not depend on how the compiler vectorises the loop.
inline constexpr std::size_t kLanes = 4;
using LaneSums = std::array<double, kLanes>;

inline double total(const LaneSums& sums) { return (sums[0] + sums[1]) + (sums[2] + sums[3]); }

// Calls `add(pixel, lane)` for every pixel; pixel i is in lane i modulo kLanes.
template <typename Add>
void for_each_pixel(std::size_t count, const Add& add) {
  const std::size_t whole = count - count % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) add(i + lane, lane);
  for (std::size_t i = whole; i < count; ++i) add(i, i - whole);
}

inline double inner_product(const float* a, const float* b, std::size_t count) {
  LaneSums sums{};
  for_each_pixel(count, [&](std::size_t i, std::size_t lane) {
    sums[lane] += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  });
  return total(sums);
}

// Returns the sum of weights * a * b.
inline double weighted_product(const float* weights, const float* a, const float* b, std::size_t count) {
  LaneSums sums{};
  for_each_pixel(count, [&](std::size_t i, std::size_t lane) {
    sums[lane] += static_cast<double>(weights[i]) * static_cast<double>(a[i]) * static_cast<double>(b[i]);
  });
  return total(sums);
}

}  // namespace remap
