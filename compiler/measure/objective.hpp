// The objective of a match: which lights the pictures have, and how much each pixel counts.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "remap/model.hpp"
#include "renderer/scene.hpp"

namespace remap {

enum class Weighting {
  kUniform,   // L2 of linear radiance (the paper)
  kRelative,  // w = cos_view / (I / max(I) + floor), from the source picture I alone
};

inline constexpr NamedValues<Weighting, 2> kWeightings = {
    {{Weighting::kUniform, "uniform"}, {Weighting::kRelative, "relative"}}};

// A match minimises, over the target's parameters, the sum over lights and pixels of w^2 (source - target)^2.
struct Objective {
  std::vector<Light> lights;
  Weighting weighting = Weighting::kRelative;
  double floor = 0.1;  // used by kRelative
};

// `paper`: headlight, uniform weights, as in the published table (section 4.1). `natural`: light at 60
// degrees, relative weights; at the same cost it gains three quarters of what the best choice of light and
// metric gains under environment maps. Throws kUsage for an unknown name.
Objective objective_preset(const std::string& name);
inline const std::vector<std::string> kObjectives = {"natural", "paper"};

// Returns w^2 for the pictures of one source material. `source` holds one picture of `view_cosines.size()`
// pixels for each light, one after the other; max(I) is taken for each picture separately.
std::vector<float> squared_weights(const Objective& objective, std::span<const float> source,
                                   std::span<const float> view_cosines);

}  // namespace remap
