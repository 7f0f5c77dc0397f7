// What "the same picture" means: which lights, and how much each pixel counts.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/scene.hpp"

namespace remapc {

enum class Weighting {
  kUniform,   // L2 of linear radiance (the paper)
  kRelative,  // w = cos_view / (I / max(I) + floor), from the source picture I alone
};

// Minimised over the target's parameters: sum over lights and pixels of w^2 (source - target)^2.
struct Objective {
  std::vector<Light> lights;
  Weighting weighting = Weighting::kRelative;
  double floor = 0.1;  // of kRelative
};

// `paper`: headlight, uniform (the published table; section 4.1). `natural`: light at 60 degrees, relative;
// it closes three quarters of what any choice of light and metric could gain under environment maps, at the
// same cost. Throws kUsage for another name.
Objective objective_preset(const std::string& name);

// `uniform` or `relative`. Throws kUsage for another name.
Weighting weighting_from_name(const std::string& name);
std::string weighting_name(Weighting weighting);

// `headlight` or degrees, comma-separated, each at `distance`. Throws kUsage.
std::vector<Light> parse_lights(const std::string& text, double distance);

// w^2 for the pictures of one source material: one picture of `view_cosines.size()` pixels a light, one after
// the other in `source`. max(I) is taken over each picture.
std::vector<float> squared_weights(const Objective& objective, std::span<const float> source,
                                   std::span<const float> view_cosines);

}  // namespace remapc
