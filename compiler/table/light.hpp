// This file handles the light of two renderers. A sweep makes it equal before it compares highlights. For
// this, it multiplies the source's pictures by the factor that makes white diffuse spheres of both renderers
// look the same. This is right if only the lights differ. If diffuse lobes differ (Oren-Nayar and Lambert),
// it wrongly changes the specular of every row.
#pragma once

#include <string>

#include "table/csv.hpp"

namespace remap {

// These comments of a table hold the factor, the RMS difference of diffuse pictures that remains, and whether
// a user has accepted both.
inline constexpr const char* kLightScaleComment = "irradiance_scale";
inline constexpr const char* kDiffuseErrorComment = "diffuse_error";
inline constexpr const char* kLightAcceptedComment = "light_accepted";

struct LightMatch {
  double scale = 1.0;  // factor for the source's pictures, which also changes the specular of the target
  double diffuse_error = 0.0;  // relative to the source's picture
  bool accepted = false;
};

// A larger scale or difference is reported. Noise and rounding errors of renderers are smaller.
inline constexpr double kSaidLightChange = 0.01;
// A larger scale changes specular by more than the error of a fit, and most people see it.
inline constexpr double kMostLightChange = 0.05;

// Returns true if specular changes by more than kMostLightChange and nobody has accepted it.
bool is_wrong_light(const LightMatch& match);

// Returns `what is wrong (what to do)`, with the numbers, or an empty text if the light matches. Sweeps,
// checks, fits and cards all use this rule.
std::string light_remark(const LightMatch& match);

// Throws kInput with the remark, beginning with `context`, if the light is wrong.
void require_light(const LightMatch& match, const std::string& context);

// Returns the match that comments record. If they record none, the light is equal.
LightMatch light_match(const Comments& comments);

}  // namespace remap
