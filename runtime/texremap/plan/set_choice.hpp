// This file chooses the maps of a found set that a conversion reads, and infers the source from map names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sets/discovery.hpp"
#include "texremap/options/convert_options.hpp"

namespace remap {

// Returns the maps of a set that may hold a parameter. Only the maps with the most suitable role are
// returned, because some sets call their base color diffuse, or their diffuse color albedo.
std::vector<MapUse> uses_of(const FoundSet& set, Parameter parameter);

// Keeps one of several maps that hold a parameter. A map that a word of `prefer` names (by its role, or by a
// part of the file name) wins. Otherwise, the map with the model's own parameter wins: roughness before
// glossiness, or the reverse if `own` is glossiness. Otherwise, a separate map wins over a channel of a
// packed map. If several maps remain, all are kept. Returns a line for each choice that the user did not ask
// for.
std::vector<std::string> choose_maps(FoundSet& set, const std::vector<Parameter>& parameters,
                                     const std::vector<std::string>& prefer,
                                     std::optional<RoughnessEncoding> own);

// An InferredSource is the source model that texremap infers, if --from is missing, from the names of maps or
// the map options.
struct InferredSource {
  std::string model;  // `metallic`, `gltf-specgloss`, `specular`
  std::string note;   // why texremap infers this model
};
// Throws kUsage if the source is unclear, or if sets of the folder differ.
InferredSource inferred_source(const ConvertOptions& options, const std::optional<Discovery>& sets);

}  // namespace remap
