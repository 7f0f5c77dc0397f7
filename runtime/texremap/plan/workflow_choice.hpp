// This file interprets `--from`, `--to` and the workflow options: both materials, and the assumed
// conventions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "remap/conversion.hpp"
#include "remap/warp.hpp"
#include "texremap/options/convert_options.hpp"
#include "texture/texture_set.hpp"

namespace remap {

struct WorkflowChoice : ConversionChoice {
  std::map<Parameter, ConstantValues> constants;  // source values for missing maps
  bool estimates_f0 = false;                      // use the F0 estimated from the maps
  bool f0_given = false;
};

// Resolves `--from` and `--to`, which are optional with `--fit`. If `--to` is a renderer, chooses its closest
// model, on paths through `--via`. Throws kUsage for an unknown name, for a workflow that contradicts the
// named model, and for options that require a workflow if neither end has a workflow.
WorkflowChoice workflow_choice(const ConvertOptions& options);

// Returns the choice for a warp: both ends have diffuse, specular and roughness, in the encoding that the
// options name. Throws kUsage for options that cannot be used with a warp, and for other models.
WorkflowChoice workflow_of_warp(const ConvertOptions& options, const WarpMapFit& fit);

struct ModelPair {
  std::string source, target;
};
// Throws kUsage if the models of the fit in `file` differ from `asked`. An empty name in `asked` accepts any
// model.
void require_models_of_fit(const std::string& file, const ModelPair& asked, const ModelPair& own);

}  // namespace remap
