// Chooses the maps that a conversion reads of a found set, and infers the source from the names of maps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sets/discovery.hpp"
#include "texremap/options/convert_options.hpp"

namespace remap {

// The maps of a set that may hold a parameter, by the best role found: some sets call their base color
// diffuse, or their diffuse color albedo.
std::vector<MapUse> uses_of(const FoundSet& set, Parameter parameter);

// Keeps one of several maps that hold a parameter: the one that a word of `prefer` names (a role, or a part
// of the file name), else the parameter of the model itself (roughness before glossiness, or the reverse for
// `own` glossiness), else a map of its own before a channel of a packed one. What stays ambiguous keeps all.
// Returns a line for each choice that nobody asked for.
std::vector<std::string> choose_maps(FoundSet& set, const std::vector<Parameter>& parameters,
                                     const std::vector<std::string>& prefer,
                                     std::optional<RoughnessEncoding> own);

// The source model that texremap infers from the names of maps or from the map options, if --from is missing.
struct InferredSource {
  std::string model;  // `metallic`, `gltf-specgloss`, `specular`
  std::string note;   // what told it
};
// Throws kUsage if nothing tells it, or if sets of the folder differ.
InferredSource inferred_source(const ConvertOptions& options, const std::optional<Discovery>& sets);

}  // namespace remap
