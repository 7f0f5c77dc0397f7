// A fit of kind `warp`: a compiled appearance warp and its provenance.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "remap/compiled_warp.hpp"

namespace remap {

struct WarpMapFit {
  std::string id;
  std::string source_model, template_model;  // of the texels before and after, such as `mitsuba/ggx`
  CompiledWarp warp;
  // RMS distance in appearance from the exact copy of template texels, as a share of the template's spread;
  // -1 if unknown.
  double copy_rms_error = -1.0;
  std::map<std::string, std::string> method;  // how it was made
  std::vector<std::string> remarks;           // warnings of the fit, a line each
  std::string tool_version;
  bool operator==(const WarpMapFit&) const = default;
};

inline constexpr const char* kWarpKind = "warp";

// The entry of `method` for a warp whose source was a diffuse map alone, with specular 0 and alpha 1.
inline constexpr const char* kWarpSourceMaps = "source_maps";
inline constexpr const char* kDiffuseAlone = "diffuse";
inline bool is_of_diffuse_alone(const WarpMapFit& fit) {
  const auto maps = fit.method.find(kWarpSourceMaps);
  return maps != fit.method.end() && maps->second == kDiffuseAlone;
}

}  // namespace remap
