// This file handles the light of two renderers, which a sweep makes equal before it compares their
// highlights. It multiplies the source's pictures by the factor that makes white diffuse spheres of both look
// the same. This is right if only the lights differ. If the diffuse lobes differ (Oren-Nayar against
// Lambert), it wrongly changes the specular of every row.
#pragma once

#include <string>

#include "table/csv.hpp"

namespace remap {

// These comments of a table hold the factor, how much the diffuse pictures still differ after it (RMS), and
// whether a user has accepted both.
inline constexpr const char* kLightScaleComment = "irradiance_scale";
inline constexpr const char* kDiffuseErrorComment = "diffuse_error";
inline constexpr const char* kLightAcceptedComment = "light_accepted";

struct LightMatch {
  double scale = 1.0;          // multiplies the source's pictures, and so the specular of the target
  double diffuse_error = 0.0;  // relative to the source's picture
  bool accepted = false;
};

// A scale or difference beyond this value is reported. Noise and rounding errors of renderers are smaller.
inline constexpr double kSaidLightChange = 0.01;
// Beyond this value, the scale changes specular by more than a fit's errors and than most people see.
inline constexpr double kMostLightChange = 0.05;

// Returns true if specular changes by more than kMostLightChange and nobody has accepted it.
bool is_wrong_light(const LightMatch& match);

// Returns `what is wrong (what to do)`, with the numbers, or an empty text if the light matches. Sweeps,
// checks, fits and cards all use this rule.
std::string light_remark(const LightMatch& match);

// Throws kInput with the remark, beginning with `context`, if the light is wrong.
void require_light(const LightMatch& match, const std::string& context);

// Returns the match that comments record. Comments without one mean equal light.
LightMatch light_match(const Comments& comments);

}  // namespace remap
