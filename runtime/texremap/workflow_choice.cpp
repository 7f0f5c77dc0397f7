#include "texremap/workflow_choice.hpp"

#include <algorithm>

#include "core/nearest_name.hpp"
#include "remap/error.hpp"
#include "remap/path.hpp"

namespace remap {
namespace {

// One end of the conversion, before both ends are known.
struct NamedEnd {
  std::string option, name;
  const WorkflowModel* model = nullptr;  // null where `name` is a BRDF model
  std::optional<WorkflowKind> kind;      // as `--from-workflow` or `--to-workflow` says

  // Has the roughness parameter of a BRDF model; an unknown one is refused later, by the search for a path.
  const ConverterGraph* graph = nullptr;

  bool has_workflow() const { return model != nullptr || kind; }
  WorkflowModel workflow() const {
    if (model == nullptr)
      return workflow_over(name, kind.value_or(WorkflowKind::kSpecular), graph->side_of(name).roughness);
    return *model;
  }
};

constexpr std::size_t kNamesShown = 5;

// Refuses a name that is neither a model, a renderer nor a workflow, with the nearest of all names.
void require_known(const std::string& option, const std::string& name, const ConverterGraph& graph) {
  if (graph.has_model(name) || !graph.models_of(name).empty() || find_workflow_model(name) != nullptr) return;
  std::vector<std::string> known = graph.models();
  for (const std::string& model : graph.models())
    if (std::ranges::find(known, renderer_of(model)) == known.end()) known.push_back(renderer_of(model));
  for (const WorkflowModel& model : workflow_models()) known.push_back(model_of(model.end));
  for (const ModelAlias& alias : model_aliases()) known.emplace_back(alias.name);
  throw Error(ErrorKind::kUsage, option + ": unknown model '" + name +
                                     "' (nearest: " + joined(nearest_names(name, known, kNamesShown), ", ") +
                                     "; all: texremap list --models and --workflows)");
}

NamedEnd named_end(const std::string& option, const std::string& name, std::optional<WorkflowKind> kind,
                   const ConverterGraph& graph) {
  NamedEnd end{option, name, find_workflow_model(name), kind, &graph};
  if (end.model != nullptr && end.kind && *end.kind != kind_of(end.model->end))
    throw Error(ErrorKind::kUsage, option + "-workflow: " + name + " has the " +
                                       std::string(kind_name(end.model->end)) + " workflow, not " +
                                       std::string(name_of(kWorkflowKinds, *kind)) + " (remove this option)");
  return end;
}

// The model that `--to` names: of a renderer the closest one to the source. A workflow around the source's
// own model of that renderer needs no other model.
std::string target_named(const ConvertOptions& options, const NamedEnd& from) {
  const std::string& to = options.to.name;
  const bool is_model = to.find('/') != std::string::npos || find_workflow_model(to) != nullptr;
  if (!options.fit.empty() || options.from.empty() || is_model) return to;
  const ConverterGraph& graph = *from.graph;
  const std::string source = from.workflow().brdf;
  if (graph.has_model(to) || graph.models_of(to).empty()) return to;
  if (renderer_of(source) == to) {
    if (from.has_workflow() || options.to_workflow) return source;
    throw Error(ErrorKind::kUsage,
                "--to: " + source + " is a model of " + to + " already (choose another model)");
  }
  const std::vector<ConverterPath> paths = graph.paths_to_renderer({source, to, options.via});
  if (paths.empty()) return graph.models_of(to).front();  // refused by the search for a path
  return target_model(closest_path(paths));
}

void set_diffuse(WorkflowEnd& end, DiffuseConvention convention) {
  std::visit([convention](auto& workflow) { workflow.diffuse = convention; }, end);
}

void set_f0(std::optional<WorkflowEnd>& end, double f0) {
  if (auto* metallic = end ? std::get_if<MetallicWorkflow>(&*end) : nullptr) metallic->dielectric_f0 = f0;
}

// Sets the diffuse convention of each end whose model leaves it open: that of the other end, so that there
// and back changes nothing, or the option's. With an option where both models say it, the source's is
// overridden.
void choose_diffuse(const ConvertOptions& options, const WorkflowModel& source, const WorkflowModel& target,
                    WorkflowChoice& choice) {
  std::vector<WorkflowEnd*> open;
  if (!source.conventions_known) open.push_back(&*choice.source);
  if (!target.conventions_known) open.push_back(&*choice.target);
  if (options.diffuse_convention) {
    if (open.empty()) open.push_back(&*choice.source);
    for (WorkflowEnd* end : open) set_diffuse(*end, *options.diffuse_convention);
    return;
  }
  if (open.empty()) return;
  const WorkflowEnd& known = source.conventions_known ? *choice.source : *choice.target;
  std::string models;
  for (WorkflowEnd* end : open) {
    set_diffuse(*end, diffuse_of(known));
    models += (models.empty() ? "" : " and ") + model_of(*end);
  }
  const bool is_plain = diffuse_of(known) == DiffuseConvention::kPlain;
  choice.assumptions.push_back(
      "diffuse of " + models + " is assumed to be " + (is_plain ? "plain" : "scaled") +
      (open.size() == 1 ? ", as in " + model_of(known) : "") + " (--diffuse-convention " +
      (is_plain ? "scaled" : "plain") + " changes that)");
}

void choose_f0(const ConvertOptions& options, WorkflowChoice& choice) {
  if (std::holds_alternative<std::monostate>(options.dielectric_f0)) return;
  const bool to_metallic_alone =
      kind_of(*choice.source) == WorkflowKind::kSpecular && choice.is_to_metallic();
  if (std::holds_alternative<FromMaps>(options.dielectric_f0)) {
    if (!to_metallic_alone)
      throw Error(ErrorKind::kUsage,
                  "--dielectric-f0: estimate requires maps of the specular workflow and a metallic target "
                  "(give a number)");
    choice.estimates_f0 = true;
    return;
  }
  if (kind_of(*choice.source) == WorkflowKind::kSpecular && !choice.is_to_metallic())
    throw Error(ErrorKind::kUsage,
                "--dielectric-f0 requires a model of the metallic workflow (remove this option)");
  choice.f0_given = true;
  set_f0(choice.source, std::get<double>(options.dielectric_f0));
  set_f0(choice.target, std::get<double>(options.dielectric_f0));
}

// Refuses options that require a workflow, or a target with metallic.
void require_workflow(const ConvertOptions& options, const WorkflowChoice& choice) {
  if (choice.is_material())
    refuse(options, kNotWithWorkflow, " cannot be used with a workflow (remove this option)");
  else
    refuse(options, kNeedsWorkflow | kNeedsMetallic,
           " requires a workflow (set --from-workflow or --to-workflow, or choose a model of texremap list "
           "--workflows)");
  if (choice.changes_nothing)
    refuse(options, kNeedsMetallic,
           ": applies to nothing, because both ends are one material (remove this option)");
  if (!choice.is_to_metallic())
    refuse(options, kNeedsMetallic, " requires a metallic target (set --to or --to-workflow)");
}

}  // namespace

std::vector<Parameter> WorkflowChoice::sources() const {
  return is_material() ? parameters_of(*source) : std::vector{Parameter::kRoughness, Parameter::kSpecular};
}

std::vector<Parameter> WorkflowChoice::targets() const {
  return is_material() ? parameters_of(*target) : std::vector{Parameter::kRoughness, Parameter::kSpecular};
}

bool WorkflowChoice::has_source(Parameter parameter) const {
  const std::vector<Parameter> all = sources();
  return std::find(all.begin(), all.end(), parameter) != all.end();
}

WorkflowChoice workflow_choice(const ConvertOptions& options) {
  const ConverterGraph graph = options.converters.graph();
  if (options.fit.empty()) {
    if (!options.from.empty()) require_known("--from", options.from.name, graph);
    if (!options.to.empty()) require_known("--to", options.to.name, graph);
  }
  const NamedEnd from = named_end("--from", options.from.name, options.from_workflow, graph);
  const std::string target_name = target_named(options, from);
  const NamedEnd to = named_end("--to", target_name, options.to_workflow, graph);
  WorkflowChoice choice;
  choice.source_brdf = options.from.name;
  choice.target_brdf = target_name;
  choice.is_closest = target_name != options.to.name;
  choice.renderer = renderer_of(target_name);
  for (const ModelName* name : {&options.from, &options.to})
    if (name->alias != nullptr)
      choice.notes.push_back(std::string(name->alias->name) + " means " + name->name + ": " +
                             std::string(name->alias->meaning));
  if (from.has_workflow() || to.has_workflow()) {
    if (options.from.empty() || options.to.empty())
      throw Error(ErrorKind::kUsage, std::string(options.from.empty() ? "--from" : "--to") + " is required");
    const WorkflowModel source = from.workflow(), target = to.workflow();
    choice.source_brdf = source.brdf;
    choice.target_brdf = target.brdf;
    choice.source = source.end;
    choice.target = target.end;
    choose_diffuse(options, source, target, choice);
    choose_f0(options, choice);
    choice.prior = options.prior;
    choice.changes_nothing = choice.source_brdf == choice.target_brdf && options.via.empty() &&
                             is_same_material(*choice.source, *choice.target);
    if (choice.changes_nothing)
      choice.notes.push_back("both ends are one material: files and encodings change, no value does");
  }
  require_workflow(options, choice);
  return choice;
}

namespace {

void refuse_with_warp(const ConvertOptions& options, OptionTags tag, const std::string& warp) {
  refuse(options, tag, " cannot be used with the warp " + warp + " (remove this option)");
}

// The source of the warp is a diffuse map alone, so the conversion has neither specular nor roughness maps.
void choose_diffuse_alone(const ConvertOptions& options, WorkflowChoice& choice) {
  refuse_with_warp(options, kNotWithDiffuseWarp, options.fit + ", which converts a diffuse map alone");
  std::get<SpecularWorkflow>(*choice.source).width = RoughnessConvention::kAlpha;
  choice.constants = {{Parameter::kSpecular, {0.0f}}, {Parameter::kRoughness, {1.0f}}};
}

}  // namespace

void require_models_of_fit(const std::string& file, const ModelPair& asked, const ModelPair& own) {
  const auto require = [&](const std::string& role, const std::string& option, const std::string& wanted,
                           const std::string& found) {
    if (!wanted.empty() && wanted != found)
      throw Error(ErrorKind::kUsage, file + ": " + role + " model is " + found + ", but " + option +
                                         " asks for " + wanted + " (remove " + option + ")");
  };
  require("source", "--from", asked.source, own.source);
  require("target", "--to", asked.target, own.target);
}

WorkflowChoice workflow_of_warp(const ConvertOptions& options, const WarpMapFit& fit) {
  refuse_with_warp(options, kNotWithWarp, options.fit);
  require_models_of_fit(options.fit, {options.from.name, options.to.name},
                        {fit.source_model, fit.template_model});
  // The warp was made from maps of roughness.
  const RoughnessConvention width =
      options.reads_glossiness() ? RoughnessConvention::kGlossiness
                                 : options.roughness_encoding.value_or(RoughnessConvention::kRoughness);
  WorkflowChoice choice;
  choice.source_brdf = fit.source_model;
  choice.target_brdf = fit.template_model;
  // `remapc warp` reads metallic sets in the same way: by equation (2), with plain diffuse.
  if (options.from_workflow == WorkflowKind::kMetallic)
    choice.source = MetallicWorkflow{fit.source_model, kCommonDielectricF0, DiffuseConvention::kPlain, width};
  else
    choice.source = SpecularWorkflow{fit.source_model, DiffuseConvention::kPlain, width};
  choice.target = SpecularWorkflow{fit.template_model, DiffuseConvention::kPlain, width};
  if (is_of_diffuse_alone(fit)) choose_diffuse_alone(options, choice);
  require_workflow(options, choice);
  return choice;
}

}  // namespace remap
