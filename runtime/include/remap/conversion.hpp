// Conversions by the names of their ends: models, workflows, renderers, and the names that people use for
// them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "remap/converter.hpp"
#include "remap/path.hpp"
#include "remap/warp.hpp"
#include "remap/workflow.hpp"

namespace remap {

// A model, workflow or renderer as somebody names it.
struct ModelName {
  std::string name;                   // as converters and workflows have it; of an alias, what it stands for
  const ModelAlias* alias = nullptr;  // that was given
  bool empty() const noexcept { return name.empty(); }
  // The alias, or the name.
  std::string_view word() const noexcept { return alias != nullptr ? alias->name : std::string_view(name); }
};
// The meaning of `word`: an alias or a workflow in upper or lower case; otherwise the word itself.
ModelName model_named(const std::string& word);

// How messages call what a request says.
struct ConversionWords {
  std::string source = "source", target = "target";
  std::string source_workflow = "source_workflow", target_workflow = "target_workflow";
  std::string dielectric_f0 = "dielectric_f0", diffuse_convention = "diffuse_convention";
  std::string all_names = "models()";  // what lists every name
};

struct ConversionRequest {
  // A BRDF model (`mitsuba/ward`) or a workflow (`gltf`); as target also a renderer, which stands for the
  // closest of its models.
  ModelName source, target;
  // A BRDF model with one of these is a layer of that kind over the model.
  std::optional<WorkflowKind> source_workflow, target_workflow;
  std::vector<std::string> via;  // models that the path visits, in this order
  std::optional<DiffuseConvention> diffuse_convention;
  std::optional<double> dielectric_f0;  // of metallic workflows, [0, 0.9]; by default the model's own
  double prior = kCleanPrior;           // of the projection, towards a metallic of 0 and 1
  // The BRDFs are those of a fit, of which the graph need not know.
  bool uses_fit_file = false;
  ConversionWords words;
};

// A resolved request.
struct ConversionChoice {
  std::string source_brdf, target_brdf;  // models of the graph of converters
  std::string renderer;     // that the target names or belongs to; empty for a workflow such as gltf
  bool is_closest = false;  // the target names the renderer, and target_brdf is the closest of its models
  // Both or neither are set. Without them, roughness and specular alone are converted.
  std::optional<WorkflowEnd> source, target;
  double prior = kCleanPrior;
  bool changes_nothing = false;          // both ends are one material: files and encodings alone change
  std::vector<std::string> notes;        // explain what the model names of the user mean
  std::vector<std::string> assumptions;  // one message per assumption

  bool is_material() const noexcept { return source.has_value(); }
  bool is_to_metallic() const noexcept {
    return is_material() && kind_of(*target) == WorkflowKind::kMetallic;
  }
  // Whether metallic is made from other values.
  bool finds_metallic() const noexcept { return is_to_metallic() && !changes_nothing; }
  // What roughness is at each end, unless somebody says otherwise. `info` is of the converter, which may have
  // another convention inside where it converts a material.
  RoughnessEncoding source_width(const ConverterInfo& info) const noexcept {
    return source ? width_of(*source) : info.source.roughness;
  }
  RoughnessEncoding target_width(const ConverterInfo& info) const noexcept {
    return target ? width_of(*target) : info.target.roughness;
  }
  // The parameters of the source and of the target, in the order of Parameter.
  std::vector<Parameter> sources() const;
  std::vector<Parameter> targets() const;
  bool has_source(Parameter parameter) const;
};

// Throws kUsage for an unknown name, and for a workflow or an F0 that contradicts the named model.
ConversionChoice choose_conversion(const ConversionRequest& request, const ConverterGraph& graph);

// The converter of a choice, and what it is made of.
struct BuiltConversion {
  std::unique_ptr<Converter> owned_brdf;  // unless `brdf` is one of the graph
  const Converter* brdf = nullptr;        // of width and specular; null if both ends share a BRDF
  ConverterPath path;                     // the steps of `brdf`
  std::optional<ConverterPath> closer;    // to a model that matches the highlight more closely (path.hpp)
  std::unique_ptr<Converter> material;    // of whole materials; null if width and specular are all

  // The whole conversion.
  const Converter& converter() const noexcept { return material ? *material : *brdf; }
  const ConverterInfo& info() const noexcept { return converter().info(); }
  // The converter whose domain limits the conversion.
  const ConverterInfo& domain() const noexcept { return brdf != nullptr ? brdf->info() : info(); }
};

// Makes the converter of a choice by the best path through `via`. The converters of `graph` must outlive the
// result. Throws kUsage if no path exists, kNumeric if a converter fails its self-test.
BuiltConversion build_conversion(const ConversionChoice& choice, const std::vector<std::string>& via,
                                 const ConverterGraph& graph, InstructionSet set = best_instruction_set());

// The same around one converter of width and specular, as of a fit.
BuiltConversion build_conversion(const ConversionChoice& choice, std::unique_ptr<Converter> brdf);

// Returns both ends of a warp. Each has plain diffuse, specular, and a width in the convention `width`. A
// metallic source is read by equation (2).
ConversionChoice choice_of_warp(const WarpMapFit& warp, WorkflowKind source, RoughnessEncoding width);

// The stages of a conversion between workflows, around `brdf`, which may be null.
WorkflowStages stages_of(const ConversionChoice& choice, const Converter* brdf);

}  // namespace remap
