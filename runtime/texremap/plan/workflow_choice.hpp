// This file finds the source and target materials from `--from`, `--to` and the workflow options, or
// from the names of maps. It assumes conventions that the options do not state, and chooses the maps that a
// conversion reads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "remap/conversion.hpp"
#include "remap/warp.hpp"
#include "sets/discovery.hpp"
#include "texremap/options/convert_options.hpp"

namespace remap {

// Resolves `--from` and `--to`, which are optional if `--converters` is a fit. If `--to` is a renderer,
// chooses its closest model, on paths through `--via`. Throws kUsage for an unknown name, for a workflow that
// contradicts the named model, and for options that require a workflow if neither end has a workflow.
ConversionChoice workflow_choice(const ConvertOptions& options);

// Returns the choice for a warp: both ends have diffuse, specular and roughness, in the encoding that the
// options name. Throws kUsage for options that cannot be used with a warp, and for other models.
ConversionChoice workflow_of_warp(const ConvertOptions& options, const WarpMapFit& fit);

// Throws kUsage if `asked`, the model of `option`, is not the fit's `own`. An empty `asked` accepts any
// model.
void require_model_of_fit(const std::string& file, const std::string& option, const std::string& asked,
                          const std::string& own);

// Throws kUsage if --from or --to states a diffuse convention. `reason` ends in an open bracket, for the
// remedy.
void refuse_diffuse(const ConvertOptions& options, const std::string& reason);

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

// If --from is missing, sets it to the source model that the names of maps or the map options show:
// `metallic`, `gltf-specgloss`, `specular`. Returns why, as a note. Throws kUsage if the source is unclear,
// or if sets of the folder differ.
std::string infer_source(ConvertOptions& options, const std::optional<Discovery>& sets);

}  // namespace remap
