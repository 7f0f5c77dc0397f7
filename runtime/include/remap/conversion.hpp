// This file describes conversions by the names of their ends: models, workflows, renderers and aliases.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "remap/converter.hpp"
#include "remap/path.hpp"
#include "remap/surface.hpp"
#include "remap/warp.hpp"
#include "remap/workflow.hpp"

namespace remap {

// A ModelName is a model, workflow or renderer as the user typed it.
struct ModelName {
  std::string name;  // name in converters and workflows; an alias is replaced by what it means
  const ModelAlias* alias = nullptr;  // the alias that the user typed
  // If set, a BRDF model has a layer of this kind above it.
  std::optional<WorkflowKind> workflow = std::nullopt;
  // The meaning of its diffuse color. If unset, the model's own, or that of the other end.
  std::optional<DiffuseConvention> diffuse = std::nullopt;
  bool empty() const noexcept { return name.empty(); }
  // Returns the alias if there is one, otherwise the name.
  std::string_view word() const noexcept { return alias != nullptr ? alias->name : std::string_view(name); }
};
// Returns the meaning of `word`, such as `mitsuba/ggx`, `metallic:mitsuba/ggx` or `plain:gltf`. Aliases and
// workflows ignore case. Other words mean themselves.
ModelName model_named(const std::string& word);
// Returns the prefixes of a model as a user types them, such as `plain:specular:`.
std::string prefixes_of(const ModelName& model);

// These words name the parts of a request in messages.
struct ConversionWords {
  std::string source = "source", target = "target", via = "via";
  std::string dielectric_f0 = "dielectric_f0";
  std::string all_names = "models()";  // how to list every name
};

struct ConversionRequest {
  // Each is a BRDF model (`mitsuba/ward`) or a workflow (`gltf`). The target may also be a renderer, which
  // means its closest model.
  ModelName source, target;
  std::vector<std::string> via;         // models that the path visits, in this order
  std::optional<double> dielectric_f0;  // for metallic workflows, 0 to 0.9; by default the model's F0
  double prior = kCleanPrior;           // prior of the projection, towards a metallic of 0 and 1
  // If true and one end is OpenPBR or standard_surface, all inputs of the surfaces are translated. Otherwise,
  // both names mean metallic workflows like glTF.
  bool translates_surfaces = false;
  ConversionWords words;
};

// A ConversionChoice is a resolved request.
struct ConversionChoice {
  std::string source_brdf, target_brdf;  // models in the graph of converters
  std::string renderer;                  // the renderer of the target; empty for a workflow such as gltf
  bool is_closest = false;  // true if the user chose a renderer, and target_brdf is its closest model
  // Both or neither are set. Without them, the conversion covers only roughness and specular.
  std::optional<WorkflowEnd> source, target;
  std::optional<SurfaceTranslation> translation;      // used for whole surfaces, instead of BRDFs
  std::map<Parameter, std::vector<float>> constants;  // values of source parameters that have no map
  double prior = kCleanPrior;
  bool changes_nothing = false;          // both ends are the same material; only files and encodings change
  std::vector<std::string> notes;        // explain the user's model names
  std::vector<std::string> assumptions;  // one message for each assumption

  bool is_material() const noexcept { return source.has_value(); }
  bool is_to_metallic() const noexcept {
    return is_material() && kind_of(*target) == WorkflowKind::kMetallic;
  }
  // Returns true if metallic is computed from other values.
  bool finds_metallic() const noexcept { return is_to_metallic() && !changes_nothing && !translation; }
  // Return the parameters of the source and those of the target, in the order of Parameter.
  std::vector<Parameter> sources() const;
  std::vector<Parameter> targets() const;
  bool has_source(Parameter parameter) const;
};

// Resolves a request. Throws kUsage for an unknown name, and for a workflow or F0 that contradicts the model.
ConversionChoice choose_conversion(const ConversionRequest& request, const ConverterGraph& graph);

// A BuiltConversion holds a choice, its converter and the parts of this converter.
struct BuiltConversion {
  ConversionChoice choice;
  std::unique_ptr<Converter> owned_brdf = {};  // set if `brdf` does not belong to the graph
  const Converter* brdf = nullptr;             // for width and specular; null if both ends share a BRDF
  ConverterPath path = {};                     // the steps of `brdf`
  std::optional<ConverterPath> closer = {};    // path to a model with a closer highlight
  std::unique_ptr<Converter> material = {};    // for whole materials; null if only width and specular change

  // Returns the converter for the whole conversion.
  const Converter& converter() const noexcept { return material ? *material : *brdf; }
  const ConverterInfo& info() const noexcept { return converter().info(); }
  // Return the default meaning of roughness at each end. A converter of materials may use another convention
  // inside.
  RoughnessEncoding source_width() const noexcept {
    return choice.source ? width_of(*choice.source) : info().source.roughness;
  }
  RoughnessEncoding target_width() const noexcept {
    return choice.target ? width_of(*choice.target) : info().target.roughness;
  }
  // Returns the info of the converter whose domain limits the conversion.
  const ConverterInfo& domain() const noexcept { return brdf != nullptr ? brdf->info() : info(); }
};

// Makes the converter of a choice by the best path through `via`. The converters of `graph` must outlive the
// result. Throws kUsage if no path exists, kNumeric if a converter fails its self-test.
BuiltConversion build_conversion(ConversionChoice choice, const std::vector<std::string>& via,
                                 const ConverterGraph& graph, InstructionSet set = best_instruction_set());

// Returns the choice for a warp. Each end has plain diffuse, specular, and a width with the encoding `width`.
// A metallic source is read by equation (2).
ConversionChoice choice_of_warp(const WarpMapFit& warp, WorkflowKind source, RoughnessEncoding width);

// Returns the stages of a conversion between workflows, around `brdf`, which may be null.
WorkflowStages stages_of(const ConversionChoice& choice, const Converter* brdf);

}  // namespace remap
