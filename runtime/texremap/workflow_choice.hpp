// What `--from`, `--to` and the options of workflows mean: which material each end is, and which conventions
// had to be assumed.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "convert/material_converter.hpp"
#include "texremap/convert_options.hpp"
#include "texture/texture_set.hpp"

namespace remap {

struct WorkflowChoice {
  std::string source_brdf, target_brdf;  // models of the graph of converters
  // Both or none: with none width and specular alone are converted.
  std::optional<WorkflowEnd> source, target;
  std::map<Parameter, ConstantValues> constants;  // of the source, in place of maps that it has not
  WorkflowFormula formula = Projection{kCleanPrior};
  bool estimates_f0 = false;  // use the F0 that the maps tell
  bool f0_given = false;
  std::vector<std::string> assumptions;  // one message each

  bool is_material() const noexcept { return source.has_value(); }
  bool is_to_metallic() const noexcept {
    return is_material() && kind_of(*target) == WorkflowKind::kMetallic;
  }
  // A parameter that the source has maps of, in the order of Parameter.
  std::vector<Parameter> sources() const;
  std::vector<Parameter> targets() const;
  bool has_source(Parameter parameter) const;
};

// `--from` or `--to` may be missing beside `--fit`. Throws kUsage for a word that there is not, for a
// workflow that a named model does not have, and for options that need a workflow where there is none.
WorkflowChoice workflow_choice(const ConvertOptions& options);

// What a warp converts: diffuse, specular and a width of both ends, in the encoding that the options name.
// Throws kUsage for options that mean nothing beside it, and for models that are not the warp's.
WorkflowChoice workflow_of_warp(const ConvertOptions& options, const WarpMapFit& fit);

// The same for two names alone.
WorkflowChoice workflow_between(const std::string& from, const std::string& to);

}  // namespace remap
