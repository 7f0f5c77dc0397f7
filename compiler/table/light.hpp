// The light of two renderers, which a sweep makes equal before it compares their highlights: the source's
// pictures are multiplied by the factor that makes white diffuse spheres of both alike. That is right where
// the lights differ. Where the diffuse lobes differ (Oren-Nayar against Lambert), it moves the specular of
// every row instead.
#pragma once

#include <optional>
#include <string>

#include "table/csv.hpp"

namespace remap {

// The comments of a table that hold the factor, how far the diffuse pictures still differ after it (RMS), and
// that a user has accepted both.
inline constexpr const char* kLightScaleComment = "irradiance_scale";
inline constexpr const char* kDiffuseErrorComment = "diffuse_error";
inline constexpr const char* kLightAcceptedComment = "light_accepted";

struct LightMatch {
  double scale = 1.0;          // multiplies the source's pictures, and so the specular of the target
  double diffuse_error = 0.0;  // relative to the source's picture
  bool accepted = false;
};

// The warning about a match of light.
struct LightRemark {
  bool is_error = false;  // the specular changes by more than kMostLightChange, and nobody has accepted it
  std::string text;       // `what is wrong (what to do)`, with the numbers
};

// Beyond this, a scale or a difference is said: noise and rounding of renderers stay below.
inline constexpr double kSaidLightChange = 0.01;
// Beyond this, the scale changes specular by more than a fit's errors and than most people see.
inline constexpr double kMostLightChange = 0.05;

// The one rule for sweeps, checks, fits and cards. None for light that matches.
std::optional<LightRemark> light_remark(const LightMatch& match);

// Throws kInput, beginning with `context`, if the remark is an error.
void require_light(const LightMatch& match, const std::string& context);

// The match that comments record; that of equal light for comments without one.
LightMatch light_match(const Comments& comments);

}  // namespace remap
