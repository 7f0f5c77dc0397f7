// A fit of kind `warp`: a compiled appearance warp with what a person should know of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "remap/compiled_warp.hpp"

namespace remap {

struct WarpMapFit {
  std::string id;                            // as of every fit
  std::string source_model, template_model;  // what texels hold before and after; `mitsuba/ggx`
  CompiledWarp warp;
  // RMS distance in appearance from the exact copy of template texels, in shares of the template's spread; -1
  // where it is not known.
  double copy_rms_error = -1.0;
  std::map<std::string, std::string> method;  // how it was made
  std::vector<std::string> remarks;           // warnings of the fit, a line each
  std::string tool_version;
  bool operator==(const WarpMapFit&) const = default;
};

inline constexpr const char* kWarpKind = "warp";

// In `method`, where the source of the warp was a diffuse map alone: its specular was taken as 0, its alpha
// as 1.
inline constexpr const char* kWarpSourceMaps = "source_maps";
inline constexpr const char* kDiffuseAlone = "diffuse";
inline bool is_of_diffuse_alone(const WarpMapFit& fit) {
  const auto maps = fit.method.find(kWarpSourceMaps);
  return maps != fit.method.end() && maps->second == kDiffuseAlone;
}

}  // namespace remap
