// The meaning of `--from`, `--to` and the workflow options: the material at each end, and the conventions
// that had to be assumed.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "remap/warp.hpp"
#include "remap/workflow.hpp"
#include "texremap/convert_options.hpp"
#include "texture/texture_set.hpp"

namespace remap {

struct WorkflowChoice {
  std::string source_brdf, target_brdf;  // models of the graph of converters
  std::string renderer;                  // that --to names or belongs to; empty for a workflow such as gltf
  bool is_closest = false;  // --to names the renderer, and target_brdf is the closest of its models
  // Both or neither are set. Without them, roughness and specular alone are converted.
  std::optional<WorkflowEnd> source, target;
  std::map<Parameter, ConstantValues> constants;  // source values in place of missing maps
  double prior = kCleanPrior;                     // of the projection, towards a metallic of 0 and 1
  bool estimates_f0 = false;                      // use the F0 estimated from the maps
  bool f0_given = false;
  bool changes_nothing = false;          // both ends are one material: files and encodings alone change
  std::vector<std::string> notes;        // what the names mean that were given for models
  std::vector<std::string> assumptions;  // one message per assumption

  bool is_material() const noexcept { return source.has_value(); }
  bool is_to_metallic() const noexcept {
    return is_material() && kind_of(*target) == WorkflowKind::kMetallic;
  }
  // Whether metallic is made from other values.
  bool finds_metallic() const noexcept { return is_to_metallic() && !changes_nothing; }
  // The parameters of the source and of the target, in the order of Parameter.
  std::vector<Parameter> sources() const;
  std::vector<Parameter> targets() const;
  bool has_source(Parameter parameter) const;
};

// `--from` and `--to` are optional with `--fit`. A renderer as `--to` stands for the closest of its models,
// by paths through `--via`. Throws kUsage for an unknown name, for a workflow that contradicts the named
// model, and for options that require a workflow where neither end has one.
WorkflowChoice workflow_choice(const ConvertOptions& options);

// The choice for a warp: both ends have diffuse, specular and roughness, in the encoding that the options
// name. Throws kUsage for options that cannot be used with a warp, and for models other than the warp's.
WorkflowChoice workflow_of_warp(const ConvertOptions& options, const WarpMapFit& fit);

struct ModelPair {
  std::string source, target;
};
// Throws kUsage if the models of the fit in `file` are not the `asked` ones; an empty name asks for any
// model.
void require_models_of_fit(const std::string& file, const ModelPair& asked, const ModelPair& own);

}  // namespace remap
