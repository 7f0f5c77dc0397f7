#include "remap/conversion.hpp"

#include <algorithm>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"
#include "stages/stage.hpp"

namespace remap {
namespace {

// A NamedEnd is one end of the conversion, before both ends are known.
struct NamedEnd {
  std::string name;
  const WorkflowModel* model = nullptr;  // null if `name` is a BRDF model
  std::optional<WorkflowKind> kind;      // kind that the user requested

  // The graph knows the roughness parameter of a BRDF model. Unknown models are refused later, in the search
  // for a path.
  const ConverterGraph* graph = nullptr;

  bool has_workflow() const { return model != nullptr || kind; }
  WorkflowModel workflow() const {
    if (model == nullptr)
      return workflow_over(name, kind.value_or(WorkflowKind::kSpecular), graph->side_of(name).roughness);
    return *model;
  }
};

constexpr std::size_t kNamesShown = 5;

// Refuses a name that is not a model, a renderer or a workflow, and suggests the closest name.
void require_known(const std::string& word, const std::string& name, const ConverterGraph& graph,
                   const std::string& all_names) {
  if (graph.has_model(name) || !graph.models_of(name).empty() || find_workflow_model(name) != nullptr) return;
  std::vector<std::string> known = graph.models();
  for (const std::string& model : graph.models())
    if (!contains(known, renderer_of(model))) known.push_back(renderer_of(model));
  for (const WorkflowModel& model : workflow_models()) known.push_back(model_of(model.end));
  for (const ModelAlias& alias : model_aliases()) known.emplace_back(alias.name);
  const std::string near = joined(nearest_names(name, known, kNamesShown), ", ");
  throw usage_error(word + ": unknown model '" + name + "' (" +
                    (near.empty() ? "" : "closest: " + near + "; ") + "all: " + all_names + ")");
}

// Refuses models of `via` that no path can pass between `source` and `target`, which are BRDF models.
void require_via(const ConversionRequest& request, const ConverterGraph& graph, const std::string& source,
                 const std::string& target) {
  const std::vector<std::string>& via = request.via;
  for (auto model = via.begin(); model != via.end(); ++model) {
    const std::string& word = request.words.via;
    const std::string place = word + " " + *model + ": ";
    if (const std::vector<std::string> own = graph.models_of(*model);
        !graph.has_model(*model) && !own.empty())
      throw usage_error(place + "is a renderer, not a model (choose one of its models: " + joined(own, ", ") +
                        ")");
    if (!graph.has_model(*model))
      throw usage_error(word + ": unknown model '" + *model + "'" + suggestion(*model, graph.models()));
    if (*model == source || *model == target)
      throw usage_error(place + "the path " + (*model == source ? "begins" : "ends") +
                        " with this model already (remove this option)");
    if (std::find(via.begin(), model, *model) != model)
      throw usage_error(place + "given twice (remove one of the two)");
  }
}

NamedEnd named_end(const std::string& name, std::optional<WorkflowKind> kind, const std::string& word,
                   const ConverterGraph& graph) {
  NamedEnd end{name, find_workflow_model(name), kind, &graph};
  if (end.model != nullptr && end.kind && *end.kind != kind_of(end.model->end))
    throw usage_error(word + " " + std::string(name_of(kWorkflowKinds, *kind)) + ":" + name + ": the model " +
                      name + " has the " + std::string(kind_name(end.model->end)) + " workflow (use " + word +
                      " " + name + ")");
  return end;
}

// Returns the model that the target names. If it names a renderer, this is the renderer's model that is
// closest to the source. If the source is a model of that renderer and a workflow is converted, the model
// stays.
std::string target_named(const ConversionRequest& request, const NamedEnd& from) {
  const std::string& to = request.target.name;
  const bool is_model = to.find('/') != std::string::npos || find_workflow_model(to) != nullptr;
  if (from.name.empty() || is_model) return to;
  const ConverterGraph& graph = *from.graph;
  const std::string source = from.workflow().brdf;
  if (graph.has_model(to) || graph.models_of(to).empty()) return to;
  if (renderer_of(source) == to) {
    if (from.has_workflow() || request.target.workflow) return source;
    throw usage_error(request.words.target + " " + to + ": the source " + source +
                      " is already a model of this renderer (choose one of its other models)");
  }
  const std::vector<ConverterPath> paths = graph.paths_to_renderer({source, to, request.via});
  if (paths.empty()) return graph.models_of(to).front();  // the search for a path refuses this model
  return target_model(closest_path(paths));
}

void set_diffuse(WorkflowEnd& end, DiffuseConvention convention) {
  std::visit([convention](auto& workflow) { workflow.diffuse = convention; }, end);
}

void set_f0(std::optional<WorkflowEnd>& end, double f0) {
  if (auto* metallic = end ? std::get_if<MetallicWorkflow>(&*end) : nullptr) metallic->dielectric_f0 = f0;
}

// Returns the surface that a name means. In other conversions, the words `openpbr` and `standard-surface`
// mean metallic workflows.
std::optional<Surface> surface_of(const ModelName& model) {
  constexpr NamedValues<Surface, 4> kWords = {{{Surface::kOpenPbr, "openpbr"},
                                               {Surface::kOpenPbr, "open-pbr-surface"},
                                               {Surface::kStandardSurface, "standard-surface"},
                                               {Surface::kStandardSurface, "arnold"}}};
  constexpr NamedValues<Surface, 4> kModels = {
      {{Surface::kGltf, "gltf"},
       {Surface::kUsdPreview, "usd-preview-surface"},
       {Surface::kUsdPreviewSpecular, "usd-preview-surface-specular"},
       {Surface::kPrincipled, "cycles-5/principled"}}};
  const auto by_word = value_named(kWords, model.word());
  return by_word ? by_word : value_named(kModels, model.name);
}

bool is_hub(Surface surface) { return surface == Surface::kOpenPbr || surface == Surface::kStandardSurface; }

// Sets the translation between surfaces if the request asks for one.
void choose_translation(const ConversionRequest& request, ConversionChoice& choice) {
  const auto source = surface_of(request.source), target = surface_of(request.target);
  if (!request.translates_surfaces || !source || !target || *source == *target ||
      (!is_hub(*source) && !is_hub(*target)))
    return;
  const auto name = [](WorkflowEnd& end, Surface surface) {
    if (is_hub(surface))
      std::get<MetallicWorkflow>(end).model = surface == Surface::kOpenPbr ? "openpbr" : "standard-surface";
  };
  const auto refuse = [&](const std::string& word) {
    throw usage_error(word + ": has no effect between " + std::string(request.source.word()) + " and " +
                      std::string(request.target.word()) + ", because formulas convert every input (remove " +
                      word + ")");
  };
  if (*target == Surface::kPrincipled)
    throw usage_error(request.words.target + " " + std::string(request.target.word()) + ": materials of " +
                      std::string(request.source.word()) +
                      " cannot become the Principled BSDF (use --to gltf, which Blender imports)");
  if (request.dielectric_f0) refuse(request.words.dielectric_f0);
  for (const ModelName* model : {&request.source, &request.target})
    if (model->diffuse) refuse(std::string(diffuse_convention_name(*model->diffuse)));
  if (!request.via.empty()) refuse("--via");
  name(*choice.source, *source);
  name(*choice.target, *target);
  choice.translation = SurfaceTranslation{*source, *target};
  choice.notes.clear();  // notes on aliases do not apply, because names mean surfaces here
  choice.changes_nothing = false;
}

// Sets the diffuse convention of each end to the requested one. An end without a request, whose model leaves
// it open, gets the convention of the other end, so that a round trip changes nothing.
void choose_diffuse(const ConversionRequest& request, const WorkflowModel& source,
                    const WorkflowModel& target, ConversionChoice& choice) {
  WorkflowEnd &from = *choice.source, &to = *choice.target;
  const bool is_asked = request.source.diffuse || request.target.diffuse;
  if (request.source.diffuse) set_diffuse(from, *request.source.diffuse);
  if (request.target.diffuse) set_diffuse(to, *request.target.diffuse);
  const bool is_source_open = !source.conventions_known && !request.source.diffuse;
  const bool is_target_open = !target.conventions_known && !request.target.diffuse;
  if (is_source_open)
    set_diffuse(from, diffuse_of(to));
  else if (is_target_open)
    set_diffuse(to, diffuse_of(from));
  if (is_asked || (!is_source_open && !is_target_open)) return;
  const bool is_plain = diffuse_of(from) == DiffuseConvention::kPlain,
             is_both = is_source_open && is_target_open;
  const ModelName& open = is_source_open ? request.source : request.target;
  choice.assumptions.push_back(
      std::string("assuming ") + (is_plain ? "plain" : "scaled") + " diffuse for " +
      (is_both ? model_of(from) + " and " + model_of(to)
               : model_of(is_source_open ? from : to) + ", as in " + model_of(is_source_open ? to : from)) +
      " (otherwise, use " + (is_source_open ? request.words.source : request.words.target) + " " +
      (is_plain ? "scaled:" : "plain:") + prefixes_of(open) + std::string(open.word()) + ")");
}

void choose_f0(const ConversionRequest& request, ConversionChoice& choice) {
  if (!request.dielectric_f0) return;
  if (kind_of(*choice.source) == WorkflowKind::kSpecular && !choice.is_to_metallic())
    throw usage_error(request.words.dielectric_f0 +
                      " requires a model of the metallic workflow (remove this option)");
  set_f0(choice.source, *request.dielectric_f0);
  set_f0(choice.target, *request.dielectric_f0);
}

void note_alias(const ModelName& given, ConversionChoice& choice) {
  if (given.alias != nullptr)
    choice.notes.push_back(std::string(given.alias->name) + " uses the model " + given.name + " (" +
                           std::string(given.alias->meaning) + ")");
}

}  // namespace

ModelName model_named(const std::string& word) {
  if (const std::size_t sign = word.find(':'); sign != std::string::npos) {
    const auto kind = value_named(kWorkflowKinds, word.substr(0, sign));
    const auto diffuse = value_named(kDiffuseConventions, word.substr(0, sign));
    if (kind || diffuse) {
      ModelName model = model_named(word.substr(sign + 1));
      if (kind) model.workflow = kind;
      if (diffuse) model.diffuse = diffuse;
      return model;
    }
  }
  if (const ModelAlias* alias = find_alias(word)) return {std::string(alias->model), alias};
  std::string small = word;
  for (char& letter : small)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return {find_workflow_model(small) != nullptr ? small : word, nullptr};
}

std::string prefixes_of(const ModelName& model) {
  return (model.diffuse ? std::string(diffuse_convention_name(*model.diffuse)) + ":" : "") +
         (model.workflow ? std::string(name_of(kWorkflowKinds, *model.workflow)) + ":" : "");
}

std::vector<Parameter> ConversionChoice::sources() const {
  if (translation) return parameters_of(translation->source);
  return is_material() ? parameters_of(*source) : std::vector{Parameter::kRoughness, Parameter::kSpecular};
}

std::vector<Parameter> ConversionChoice::targets() const {
  if (translation) return parameters_of(translation->target);
  return is_material() ? parameters_of(*target) : std::vector{Parameter::kRoughness, Parameter::kSpecular};
}

bool ConversionChoice::has_source(Parameter parameter) const {
  const std::vector<Parameter> all = sources();
  return contains(all, parameter);
}

ConversionChoice choose_conversion(const ConversionRequest& request, const ConverterGraph& graph) {
  const ConversionWords& words = request.words;
  if (!request.source.empty()) require_known(words.source, request.source.name, graph, words.all_names);
  if (!request.target.empty()) require_known(words.target, request.target.name, graph, words.all_names);
  const NamedEnd from = named_end(request.source.name, request.source.workflow, words.source, graph);
  if (!from.name.empty()) require_via(request, graph, from.workflow().brdf, "");
  const std::string target = target_named(request, from);
  const NamedEnd to = named_end(target, request.target.workflow, words.target, graph);
  if (!from.name.empty() && !target.empty())
    require_via(request, graph, from.workflow().brdf, to.workflow().brdf);
  ConversionChoice choice;
  choice.source_brdf = from.name;
  choice.target_brdf = target;
  choice.is_closest = target != request.target.name;
  choice.renderer = renderer_of(target);
  note_alias(request.source, choice);
  note_alias(request.target, choice);
  if (!from.has_workflow() && !to.has_workflow()) {
    for (const ModelName* model : {&request.source, &request.target})
      if (model->diffuse)
        throw usage_error((model == &request.source ? words.source : words.target) + " " +
                          prefixes_of(*model) + model->name + ": " + model->name +
                          " has no diffuse without a workflow (write " + prefixes_of(*model) +
                          "specular:" + model->name + ")");
    return choice;
  }
  if (from.name.empty() || request.target.empty())
    throw usage_error((from.name.empty() ? words.source : words.target) + " is required");
  const WorkflowModel source_end = from.workflow(), target_end = to.workflow();
  choice.source_brdf = source_end.brdf;
  choice.target_brdf = target_end.brdf;
  choice.source = source_end.end;
  choice.target = target_end.end;
  choose_translation(request, choice);
  if (choice.translation) return choice;
  choose_diffuse(request, source_end, target_end, choice);
  choose_f0(request, choice);
  choice.prior = request.prior;
  choice.changes_nothing = choice.source_brdf == choice.target_brdf && request.via.empty() &&
                           is_same_material(*choice.source, *choice.target);
  if (choice.changes_nothing)
    choice.notes.push_back(
        "source and target have the same material model: files and encodings change, but no value does");
  return choice;
}

WorkflowStages stages_of(const ConversionChoice& choice, const Converter* brdf) {
  WorkflowStages stages{*choice.source, *choice.target};
  stages.brdf = brdf;
  stages.width = width_of(stages.target);
  stages.prior = choice.prior;
  return stages;
}

namespace {

// Adds the stages of the workflows around the BRDF.
BuiltConversion with_material(BuiltConversion conversion, InstructionSet set) {
  if (conversion.brdf != nullptr && !conversion.brdf->self_test())
    throw numeric_error(conversion.brdf->info().id + ": self-test failed (results would be wrong)");
  if (conversion.choice.is_material())
    conversion.material = make_workflow_converter(stages_of(conversion.choice, conversion.brdf), set);
  return conversion;
}

}  // namespace

BuiltConversion build_conversion(ConversionChoice chosen, const std::vector<std::string>& via,
                                 const ConverterGraph& graph, InstructionSet set) {
  BuiltConversion conversion{std::move(chosen)};
  const ConversionChoice& choice = conversion.choice;
  if (choice.translation) {
    conversion.material =
        make_translation_converter(*choice.translation, ends_of(stages_of(choice, nullptr), set));
    return conversion;
  }
  if (!choice.is_material() || choice.source_brdf != choice.target_brdf || !via.empty()) {
    conversion.path = graph.find_paths({choice.source_brdf, choice.target_brdf, via}).front();
    conversion.closer =
        closer_path(conversion.path, graph.paths_to_renderer({choice.source_brdf, choice.renderer, {}}));
    if (conversion.path.steps.size() > 1)
      conversion.owned_brdf = make_chained_converter(conversion.path.steps);
    conversion.brdf = conversion.owned_brdf ? conversion.owned_brdf.get() : conversion.path.steps.front();
  }
  return with_material(std::move(conversion), set);
}

ConversionChoice choice_of_warp(const WarpMapFit& warp, WorkflowKind source, RoughnessEncoding width) {
  ConversionChoice choice;
  choice.source_brdf = warp.source_model;
  choice.target_brdf = warp.template_model;
  if (source == WorkflowKind::kMetallic)
    choice.source =
        MetallicWorkflow{warp.source_model, kCommonDielectricF0, DiffuseConvention::kPlain, width};
  else
    choice.source = SpecularWorkflow{warp.source_model, DiffuseConvention::kPlain, width};
  choice.target = SpecularWorkflow{warp.template_model, DiffuseConvention::kPlain, width};
  return choice;
}

}  // namespace remap
