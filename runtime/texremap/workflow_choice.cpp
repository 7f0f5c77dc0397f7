#include "texremap/workflow_choice.hpp"

#include <algorithm>

#include "remap/closeness.hpp"
#include "remap/error.hpp"
#include "remap/shipped_converters.hpp"
#include "text/number_text.hpp"

namespace remap {
namespace {

std::optional<WorkflowKind> kind_named(const std::string& option, const std::string& word) {
  if (word.empty()) return std::nullopt;
  return chosen_value(kWorkflowKinds, option, "workflow", word);
}

// The roughness parameter of a model of the graph. An unknown model is refused later, by the search for a
// path.
RoughnessConvention width_of_brdf(const std::string& model) {
  for (const auto& converter : shipped_converters()) {
    if (converter->info().source.model == model) return converter->info().source.roughness;
    if (converter->info().target.model == model) return converter->info().target.roughness;
  }
  return RoughnessConvention::kAlpha;
}

// One end of the conversion, before both ends are known.
struct NamedEnd {
  std::string option, name;
  const WorkflowModel* model = nullptr;  // null where `name` is a BRDF model
  std::optional<WorkflowKind> kind;      // as `--from-workflow` or `--to-workflow` says

  bool has_workflow() const { return model != nullptr || kind; }
  WorkflowModel workflow() const {
    if (model == nullptr)
      return workflow_over(name, kind.value_or(WorkflowKind::kSpecular), width_of_brdf(name));
    return *model;
  }
};

NamedEnd named_end(const std::string& option, const std::string& name, const std::string& kind) {
  NamedEnd end{option, name, find_workflow_model(name), kind_named(option + "-workflow", kind)};
  if (end.model != nullptr && end.kind && *end.kind != kind_of(end.model->end))
    throw Error(ErrorKind::kUsage, option + "-workflow: " + name + " has the " +
                                       std::string(kind_name(end.model->end)) + " workflow, not " + kind +
                                       " (remove this option)");
  return end;
}

// The model that `--to` names: of a renderer the closest one to the source. A workflow around the source's
// own model of that renderer needs no other model.
std::string target_named(const ConvertOptions& options, const NamedEnd& from) {
  const bool is_model =
      options.to.find('/') != std::string::npos || find_workflow_model(options.to) != nullptr;
  if (!options.fit.empty() || options.from.empty() || is_model) return options.to;
  const ConverterGraph graph = shipped_graph();
  const std::string source = from.workflow().brdf;
  if (graph.has_model(options.to) || graph.models_of(options.to).empty()) return options.to;
  if (renderer_of(source) == options.to) {
    if (from.has_workflow() || !options.to_workflow.empty()) return source;
    throw Error(ErrorKind::kUsage,
                "--to: " + source + " is a model of " + options.to + " already (choose another model)");
  }
  const std::vector<ConverterPath> paths = graph.paths_to_renderer({source, options.to, options.via});
  if (paths.empty()) return graph.models_of(options.to).front();  // refused by the search for a path
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
  if (!options.diffuse_convention.empty()) {
    if (open.empty()) open.push_back(&*choice.source);
    for (WorkflowEnd* end : open)
      set_diffuse(*end, chosen_value(kDiffuseConventions, "--diffuse-convention", "convention",
                                     options.diffuse_convention));
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

// The number from 0 to `highest` in `text`; `allowed` tells the user what the option takes.
double number_of(const std::string& option, const std::string& text, double highest,
                 const std::string& allowed) {
  const auto number = parse_number(text);
  if (!number || !(*number >= 0.0 && *number <= highest))
    throw Error(ErrorKind::kUsage, option + ": invalid value '" + text + "' (use " + allowed + ")");
  return *number;
}

void choose_f0(const ConvertOptions& options, WorkflowChoice& choice) {
  if (options.dielectric_f0.empty()) return;
  const bool to_metallic_alone =
      kind_of(*choice.source) == WorkflowKind::kSpecular && choice.is_to_metallic();
  if (options.dielectric_f0 == "estimate") {
    if (!to_metallic_alone)
      throw Error(ErrorKind::kUsage,
                  "--dielectric-f0: estimate requires maps of the specular workflow and a metallic target "
                  "(give a number)");
    choice.estimates_f0 = true;
    return;
  }
  const double f0 = number_of("--dielectric-f0", options.dielectric_f0, 0.9, "0 to 0.9, or estimate");
  if (kind_of(*choice.source) == WorkflowKind::kSpecular && !choice.is_to_metallic())
    throw Error(ErrorKind::kUsage,
                "--dielectric-f0 requires a model of the metallic workflow (remove this option)");
  choice.f0_given = true;
  set_f0(choice.source, f0);
  set_f0(choice.target, f0);
}

WorkflowFormula formula_of(const ConvertOptions& options) {
  double prior = kCleanPrior;
  if (options.prior == "noisy")
    prior = kNoisyPrior;
  else if (!options.prior.empty() && options.prior != "clean")
    prior = number_of("--prior", options.prior, kLargestPrior, "clean, noisy, or a number from 0 to 1");
  const std::string& name = options.formula;
  if (name.empty() || name == "projection") return Projection{prior};
  if (!options.prior.empty())
    throw Error(ErrorKind::kUsage,
                "--prior cannot be used with --formula " + name + " (only with projection)");
  if (name == "equation-3") return Equation3{MetallicMean::kAlbedo};
  if (name == "equation-3-mean") return Equation3{MetallicMean::kPlain};
  if (name == "khronos") return KhronosSolver{};
  fail_unknown("--formula", "formula", name, {"projection", "equation-3", "equation-3-mean", "khronos"});
}

// Refuses options that require a workflow, or a target with metallic.
void require_workflow(const ConvertOptions& options, const WorkflowChoice& choice) {
  struct Entry {
    const char* option;
    bool given, needs_metallic;
  };
  const Entry entries[] = {{"--dielectric-f0", !options.dielectric_f0.empty(), false},
                           {"--diffuse-convention", !options.diffuse_convention.empty(), false},
                           {"--formula", !options.formula.empty(), true},
                           {"--prior", !options.prior.empty(), true},
                           {"--residual", !options.residual.empty(), true},
                           {"--metallic-width", !options.metallic_width.empty(), true},
                           {"--doubts", !options.doubts.empty(), true},
                           {"--smooth-metallic", options.smooth_metallic, true},
                           {"--metal-mask", !options.metal_mask.empty(), true}};
  for (const Entry& entry : entries) {
    if (!entry.given) continue;
    if (!choice.is_material())
      throw Error(ErrorKind::kUsage,
                  std::string(entry.option) +
                      " requires a workflow (set --from-workflow or --to-workflow, or choose a model of "
                      "texremap list --workflows)");
    if (entry.needs_metallic && !choice.is_to_metallic())
      throw Error(ErrorKind::kUsage,
                  std::string(entry.option) + " requires a metallic target (set --to or --to-workflow)");
  }
  if (choice.is_material() && !options.only.empty())
    throw Error(ErrorKind::kUsage, "--only cannot be used with a workflow (remove this option)");
}

}  // namespace

std::vector<Parameter> WorkflowChoice::sources() const {
  return is_material() ? parameters_of(*source) : std::vector{Parameter::kWidth, Parameter::kSpecular};
}

std::vector<Parameter> WorkflowChoice::targets() const {
  return is_material() ? parameters_of(*target) : std::vector{Parameter::kWidth, Parameter::kSpecular};
}

bool WorkflowChoice::has_source(Parameter parameter) const {
  const std::vector<Parameter> all = sources();
  return std::find(all.begin(), all.end(), parameter) != all.end();
}

WorkflowChoice workflow_choice(const ConvertOptions& options) {
  const NamedEnd from = named_end("--from", options.from, options.from_workflow);
  const std::string target_name = target_named(options, from);
  const NamedEnd to = named_end("--to", target_name, options.to_workflow);
  WorkflowChoice choice;
  choice.source_brdf = options.from;
  choice.target_brdf = target_name;
  choice.is_closest = target_name != options.to;
  choice.renderer = renderer_of(target_name);
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
    choice.formula = formula_of(options);
    if (choice.source == choice.target)
      throw Error(ErrorKind::kUsage, "--to: " + options.to + " is the same material as --from " +
                                         options.from + " (choose another model)");
  }
  require_workflow(options, choice);
  return choice;
}

namespace {

using GivenOptions = std::vector<std::pair<const char*, bool>>;  // name, and whether it was given

void refuse_with_warp(const GivenOptions& options, const std::string& warp) {
  for (const auto& [option, given] : options)
    if (given)
      throw Error(ErrorKind::kUsage,
                  std::string(option) + " cannot be used with the warp " + warp + " (remove this option)");
}

// The source of the warp is a diffuse map alone, so the conversion has neither specular nor roughness maps.
void choose_diffuse_alone(const ConvertOptions& options, WorkflowChoice& choice) {
  refuse_with_warp({{"--from-workflow", !options.from_workflow.empty()},
                    {"--specular", !options.specular.empty()},
                    {"--specular-factor", !options.specular_factor.empty()},
                    {"--roughness", !options.roughness.empty()},
                    {"--roughness-factor", !options.roughness_factor.empty()},
                    {"--roughness-encoding", !options.encoding.empty()},
                    {"--glossiness", !options.glossiness.empty()}},
                   options.fit + ", which converts a diffuse map alone");
  std::get<SpecularWorkflow>(*choice.source).width = RoughnessConvention::kAlpha;
  choice.constants = {{Parameter::kSpecular, {0.0f}}, {Parameter::kWidth, {1.0f}}};
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
  refuse_with_warp({{"--to-workflow", !options.to_workflow.empty()},
                    {"--dielectric-f0", !options.dielectric_f0.empty()},
                    {"--diffuse-convention", !options.diffuse_convention.empty()}},
                   options.fit);
  require_models_of_fit(options.fit, {options.from, options.to}, {fit.source_model, fit.template_model});
  RoughnessConvention width = RoughnessConvention::kRoughness;  // the warp was made from such maps
  if (!options.glossiness.empty())
    width = RoughnessConvention::kGlossiness;
  else if (const auto named = convention_from_name(options.encoding))
    width = *named;
  WorkflowChoice choice;
  choice.source_brdf = fit.source_model;
  choice.target_brdf = fit.template_model;
  // `remapc warp` reads metallic sets in the same way: by equation (2), with plain diffuse.
  if (kind_named("--from-workflow", options.from_workflow) == WorkflowKind::kMetallic)
    choice.source = MetallicWorkflow{fit.source_model, kCommonDielectricF0, DiffuseConvention::kPlain, width};
  else
    choice.source = SpecularWorkflow{fit.source_model, DiffuseConvention::kPlain, width};
  choice.target = SpecularWorkflow{fit.template_model, DiffuseConvention::kPlain, width};
  if (is_of_diffuse_alone(fit)) choose_diffuse_alone(options, choice);
  require_workflow(options, choice);
  return choice;
}

}  // namespace remap
