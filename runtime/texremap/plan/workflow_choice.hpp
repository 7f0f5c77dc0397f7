// This file finds the source and target materials from `--from`, `--to` and the workflow options. It assumes
// conventions that the options do not state.
#pragma once

#include <string>

#include "remap/conversion.hpp"
#include "remap/warp.hpp"
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

}  // namespace remap
