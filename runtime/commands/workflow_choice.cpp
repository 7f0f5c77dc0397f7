#include "commands/workflow_choice.hpp"

#include <algorithm>

#include "convert/path.hpp"
#include "convert/shipped_converters.hpp"
#include "error.hpp"
#include "number_text.hpp"

namespace remap {
namespace {

std::optional<WorkflowKind> kind_named(const std::string& option, const std::string& word) {
  if (word.empty()) return std::nullopt;
  const auto kind = workflow_kind_from_name(word);
  if (!kind) fail_unknown(option, word, workflow_kind_names());
  return kind;
}

// A model of the graph has its own width parameter; a name that there is not is refused where the path is
// looked for.
RoughnessConvention width_of_brdf(const std::string& model) {
  for (const auto& converter : shipped_converters()) {
    if (converter->info().source.model == model) return converter->info().source.roughness;
    if (converter->info().target.model == model) return converter->info().target.roughness;
  }
  return RoughnessConvention::kAlpha;
}

// One end before both are known.
struct NamedEnd {
  std::string option, name;
  const WorkflowModel* model = nullptr;  // of that name
  std::optional<WorkflowKind> kind;      // that was asked for

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
    throw Error(ErrorKind::kUsage, option + "-workflow: is " + kind + ", and " + name + " has the " +
                                       std::string(workflow_kind_name(kind_of(end.model->end))) +
                                       " workflow; expected that, or no such option");
  return end;
}

void set_diffuse(WorkflowEnd& end, DiffuseConvention convention) {
  std::visit([convention](auto& workflow) { workflow.diffuse = convention; }, end);
}

void set_f0(std::optional<WorkflowEnd>& end, double f0) {
  if (auto* metallic = end ? std::get_if<MetallicWorkflow>(&*end) : nullptr) metallic->dielectric_f0 = f0;
}

// The maps' diffuse convention, and that of a target that names none.
void choose_diffuse(const ConvertOptions& options, const WorkflowModel& source, const WorkflowModel& target,
                    WorkflowChoice& choice) {
  if (!options.diffuse_convention.empty()) {
    const auto convention = diffuse_convention_from_name(options.diffuse_convention);
    if (!convention)
      fail_unknown("--diffuse-convention", options.diffuse_convention, diffuse_convention_names());
    set_diffuse(*choice.source, *convention);
  } else if (!source.conventions_known) {
    const std::string other = diffuse_of(*choice.source) == DiffuseConvention::kPlain ? "scaled" : "plain";
    choice.assumptions.push_back(
        "diffuse of " + model_of(*choice.source) + " is taken as " +
        std::string(diffuse_convention_name(diffuse_of(*choice.source))) +
        ", which no map can tell; --diffuse-convention " + other +
        (other == "scaled" ? " where the light that specular reflects is taken from it, as in glTF" : ""));
  }
  if (!target.conventions_known) set_diffuse(*choice.target, diffuse_of(*choice.source));
}

double number_of(const std::string& option, const std::string& text, const std::string& expected) {
  const auto number = parse_number(text);
  if (!number) throw Error(ErrorKind::kUsage, option + ": is " + text + "; expected " + expected);
  return *number;
}

void choose_f0(const ConvertOptions& options, WorkflowChoice& choice) {
  if (options.dielectric_f0.empty()) return;
  const bool to_metallic_alone =
      kind_of(*choice.source) == WorkflowKind::kSpecular && choice.is_to_metallic();
  if (options.dielectric_f0 == "estimate") {
    if (!to_metallic_alone)
      throw Error(ErrorKind::kUsage,
                  "--dielectric-f0: is estimate, which takes maps of the specular workflow and a metallic "
                  "target; expected a number");
    choice.estimates_f0 = true;
    return;
  }
  const double f0 = number_of("--dielectric-f0", options.dielectric_f0, "0 to 0.9, or estimate");
  if (!(f0 >= 0.0 && f0 <= 0.9))
    throw Error(ErrorKind::kUsage,
                "--dielectric-f0: is " + options.dielectric_f0 + "; expected 0 to 0.9, or estimate");
  if (kind_of(*choice.source) == WorkflowKind::kSpecular && !choice.is_to_metallic())
    throw Error(ErrorKind::kUsage,
                "--dielectric-f0: is for metallic, which neither end has; expected no such option");
  choice.f0_given = true;
  set_f0(choice.source, f0);
  set_f0(choice.target, f0);
}

WorkflowFormula formula_of(const ConvertOptions& options) {
  double prior = kCleanPrior;
  if (options.prior == "noisy")
    prior = kNoisyPrior;
  else if (!options.prior.empty() && options.prior != "clean")
    prior = number_of("--prior", options.prior, "clean, noisy, or a number from 0 to 1");
  if (!(prior >= 0.0 && prior <= kLargestPrior))
    throw Error(ErrorKind::kUsage,
                "--prior: is " + options.prior + "; expected clean, noisy, or a number from 0 to 1");
  const std::string& name = options.formula;
  if (name.empty() || name == "projection") return Projection{prior};
  if (!options.prior.empty())
    throw Error(ErrorKind::kUsage, "--prior: is of --formula projection; expected no --formula " + name);
  if (name == "equation-3") return Equation3{MetallicMean::kAlbedo};
  if (name == "equation-3-mean") return Equation3{MetallicMean::kPlain};
  if (name == "khronos") return KhronosSolver{};
  fail_unknown("--formula", name, {"projection", "equation-3", "equation-3-mean", "khronos"});
}

// Options that mean nothing for width and specular alone, or for a target without metallic.
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
                      ": is for workflows; expected --from-workflow or --to-workflow, or a "
                      "model that has one (texremap list --workflows)");
    if (entry.needs_metallic && !choice.is_to_metallic())
      throw Error(ErrorKind::kUsage,
                  std::string(entry.option) + ": is for metallic results; expected a metallic target");
  }
  if (choice.is_material() && !options.only.empty())
    throw Error(ErrorKind::kUsage,
                "--only: is for width and specular alone; expected no such option beside a workflow");
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
  const NamedEnd from = named_end("--from", options.from, options.from_workflow),
                 to = named_end("--to", options.to, options.to_workflow);
  WorkflowChoice choice;
  choice.source_brdf = options.from;
  choice.target_brdf = options.to;
  if (from.has_workflow() || to.has_workflow()) {
    if (options.from.empty() || options.to.empty())
      throw Error(ErrorKind::kUsage, std::string(options.from.empty() ? "--from" : "--to") +
                                         ": is missing; expected --from and --to");
    const WorkflowModel source = from.workflow(), target = to.workflow();
    choice.source_brdf = source.brdf;
    choice.target_brdf = target.brdf;
    choice.source = source.end;
    choice.target = target.end;
    choose_diffuse(options, source, target, choice);
    choose_f0(options, choice);
    choice.formula = formula_of(options);
    if (choice.source == choice.target)
      throw Error(ErrorKind::kUsage,
                  options.from + " to " + options.to + ": is the same material; expected two models");
  }
  require_workflow(options, choice);
  return choice;
}

namespace {

// A warp whose source was diffuse alone knows nothing of a lobe beside it.
void choose_diffuse_alone(const ConvertOptions& options, WorkflowChoice& choice) {
  const std::pair<const char*, bool> refused[] = {{"--from-workflow", !options.from_workflow.empty()},
                                                  {"--specular", !options.specular.empty()},
                                                  {"--specular-factor", !options.specular_factor.empty()},
                                                  {"--roughness", !options.roughness.empty()},
                                                  {"--roughness-factor", !options.roughness_factor.empty()},
                                                  {"--roughness-encoding", !options.encoding.empty()},
                                                  {"--glossiness", !options.glossiness.empty()}};
  for (const auto& [option, given] : refused)
    if (given)
      throw Error(ErrorKind::kUsage, std::string(option) + ": means nothing to the warp " + options.fit +
                                         ", whose source is a diffuse map alone; expected no such option");
  std::get<SpecularWorkflow>(*choice.source).width = RoughnessConvention::kAlpha;
  choice.constants = {{Parameter::kSpecular, {0.0f}}, {Parameter::kWidth, {1.0f}}};
}

}  // namespace

WorkflowChoice workflow_of_warp(const ConvertOptions& options, const WarpMapFit& fit) {
  const std::pair<const char*, bool> refused[] = {
      {"--to-workflow", !options.to_workflow.empty()},
      {"--dielectric-f0", !options.dielectric_f0.empty()},
      {"--diffuse-convention", !options.diffuse_convention.empty()}};
  for (const auto& [option, given] : refused)
    if (given)
      throw Error(ErrorKind::kUsage, std::string(option) + ": means nothing to the warp " + options.fit +
                                         ", which has seen its maps; expected no such option");
  const auto require_model = [&](const char* option, const std::string& asked, const std::string& own) {
    if (!asked.empty() && asked != own)
      throw Error(ErrorKind::kUsage,
                  options.fit + ": is a warp of " + own + "; expected " + asked + " of " + option);
  };
  require_model("--from", options.from, fit.source_model);
  require_model("--to", options.to, fit.template_model);
  RoughnessConvention width = RoughnessConvention::kRoughness;  // as the warp was made from such maps
  if (!options.glossiness.empty())
    width = RoughnessConvention::kGlossiness;
  else if (const auto named = convention_from_name(options.encoding))
    width = *named;
  WorkflowChoice choice;
  choice.source_brdf = fit.source_model;
  choice.target_brdf = fit.template_model;
  // As `remapc warp` reads metallic sets: by equation (2), diffuse plain.
  if (kind_named("--from-workflow", options.from_workflow) == WorkflowKind::kMetallic)
    choice.source = MetallicWorkflow{fit.source_model, kCommonDielectricF0, DiffuseConvention::kPlain, width};
  else
    choice.source = SpecularWorkflow{fit.source_model, DiffuseConvention::kPlain, width};
  choice.target = SpecularWorkflow{fit.template_model, DiffuseConvention::kPlain, width};
  if (is_of_diffuse_alone(fit)) choose_diffuse_alone(options, choice);
  require_workflow(options, choice);
  return choice;
}

WorkflowChoice workflow_between(const std::string& from, const std::string& to) {
  ConvertOptions options;
  options.from = from;
  options.to = to;
  return workflow_choice(options);
}

}  // namespace remap
