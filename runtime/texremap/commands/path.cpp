// This file is `texremap path`. It explains which converters `convert` uses from one model to another, with
// their errors and the reason for the choice.
#include "remap/path.hpp"

#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "converter/converter_data.hpp"
#include "texremap/commands/commands.hpp"
#include "texremap/plan/converter_text.hpp"
#include "texremap/plan/workflow_choice.hpp"

namespace remap {
namespace {

// These are the chosen path and the next best two.
constexpr std::size_t kPathsShown = 3;

// A Plan holds the paths and errors that the command prints.
struct Plan {
  std::vector<ConverterPath> paths;     // the chosen path and the next best
  ConverterInfo whole;                  // domain and errors of the chosen path
  std::optional<ConverterPath> closer;  // a path to a model of the same renderer that matches more closely
};

// Returns the reason why the first of `paths` was chosen.
std::string reason(const std::vector<ConverterPath>& paths) {
  if (paths.size() == 1) return "it is the only path";
  const ConverterPath &best = paths[0], &next = paths[1];
  if (best.expected_error < next.expected_error) return "its highlight is the closest";
  if (best.steps.size() < next.steps.size())
    return "no path has a closer highlight, and equally close paths have more steps";
  return "no path has a closer highlight, and its ids come first in the alphabet";
}

void print_step(std::size_t number, const Converter& step) {
  std::cout << "  " << number << "  " << step.info().id << '\n'
            << "     " << difference_text({{&step}}) << '\n'
            << "     covers " << domain_text(step.info()) << '\n';
}

void print_text(const Plan& plan) {
  const std::vector<ConverterPath>& paths = plan.paths;
  const ConverterPath& path = paths.front();
  std::cout << models_text(path) << '\n';
  for (std::size_t i = 0; i < path.steps.size(); ++i) print_step(i + 1, *path.steps[i]);
  std::cout << difference_text(path) << '\n'
            << "covers " << domain_text(plan.whole) << '\n'
            << "chosen because " << reason(paths) << '\n';
  if (plan.closer) std::cout << "note: " << closer_text(*plan.closer) << '\n';
  for (std::size_t i = 1; i < paths.size(); ++i) {
    std::cout << (i == 1 ? "next best: " : "           ") << models_text(paths[i]) << ", "
              << difference_text(paths[i]) << " (";
    for (std::size_t k = 0; k < paths[i].steps.size(); ++k)
      std::cout << (k == 0 ? "" : ", ") << paths[i].steps[k]->info().id;
    std::cout << ")\n";
  }
}

Json step_json(const ConverterInfo& info) {
  return {{"id", info.id},
          {"source", side_json(info.source)},
          {"target", side_json(info.target)},
          {"domain", domain_json(info)},
          {"rms_error", errors_json(info)},
          {"ssim", ssim_json(info)},
          {"expected_error", expected_error(info)}};
}

Json plan_json(const Plan& plan) {
  const std::vector<ConverterPath>& paths = plan.paths;
  Json steps = Json::list(), alternatives = Json::list();
  for (const Converter* step : paths.front().steps) steps.push_back(step_json(step->info()));
  for (std::size_t i = 1; i < paths.size(); ++i)
    alternatives.push_back({{"models", path_models(paths[i])},
                            {"path", path_json(paths[i])},
                            {"expected_error", paths[i].expected_error}});
  Json result = {{"models", path_models(paths.front())},
                 {"path", path_json(paths.front())},
                 {"expected_error", paths.front().expected_error},
                 {"assumed_image_error", kAssumedImageError},
                 {"domain", domain_json(plan.whole)},
                 {"steps", steps},
                 {"reason", reason(paths)},
                 {"alternatives", alternatives}};
  result.update(pictures_json(paths.front(), plan.closer));
  return result;
}

std::string end_text(const WorkflowEnd& end, const std::string& brdf) {
  return model_of(end) + ": " + std::string(kind_name(end)) + " over " + brdf + ", diffuse " +
         std::string(diffuse_convention_name(diffuse_of(end)));
}

// Returns the stages of a material conversion, with the models at both ends.
std::vector<std::string> stage_texts(const ConversionChoice& choice) {
  std::vector<std::string> stages = {end_text(*choice.source, choice.source_brdf)};
  const bool from_metallic = kind_of(*choice.source) == WorkflowKind::kMetallic;
  if (from_metallic && (choice.source_brdf != choice.target_brdf || !choice.is_to_metallic()))
    stages.push_back("to diffuse and specular by equation (2) of Sztrajman et al. 2019, exact");
  if (choice.source_brdf != choice.target_brdf)
    stages.push_back("roughness and specular from " + choice.source_brdf + " to " + choice.target_brdf);
  if (choice.finds_metallic()) stages.push_back("to base color and metallic by projection");
  stages.push_back(end_text(*choice.target, choice.target_brdf));
  return stages;
}

Plan plan_of(const ConverterGraph& graph, const PathRequest& request, const ConversionChoice& choice) {
  Plan plan;
  plan.paths = graph.find_paths(request, kPathsShown);
  plan.whole = make_chained_converter(plan.paths.front().steps)->info();
  plan.closer =
      closer_path(plan.paths.front(), graph.paths_to_renderer({request.source, choice.renderer, {}}));
  return plan;
}

void explain(const ConvertOptions& options) {
  const ConversionChoice choice = workflow_choice(options);
  const std::vector<std::string> stages =
      choice.is_material() ? stage_texts(choice) : std::vector<std::string>{};
  std::optional<Plan> plan;
  if (!choice.is_material() || choice.source_brdf != choice.target_brdf || !options.via.empty())
    plan = plan_of(options.converters.graph(), {choice.source_brdf, choice.target_brdf, options.via}, choice);
  if (options.json) {
    Json result = plan ? plan_json(*plan) : Json{{"path", Json::list()}, {"expected_error", 0.0}};
    result["closest_of"] = choice.is_closest ? Json(choice.renderer) : Json();
    if (choice.is_material()) result["stages"] = stages;
    result["notes"] = choice.notes;
    std::cout << result.dump(2) << '\n';
    return;
  }
  for (const std::string& note : choice.notes) std::cout << note << '\n';
  if (choice.is_closest) std::cout << closest_text(choice.target_brdf) << '\n';
  for (const std::string& stage : stages) std::cout << stage << '\n';
  if (plan) print_text(*plan);
}

}  // namespace

void add_path_command(Command& app) {
  Command* command = app.add_subcommand("path", "Explain which converters lead from one model to another");
  ConvertOptions& options = set_work<ConvertOptions>(*command, explain);
  command->add_option("--from MODEL", options.from, model_name(), "Source model, e.g. mitsuba/ward or unity")
      ->required();
  command
      ->add_option(
          "--to MODEL", options.to, model_name(),
          "Target model, e.g. mitsuba/as, or a renderer, e.g. cycles-5, for the closest of its models")
      ->required();
  command
      ->add_option("--via MODEL", options.via, "Model that the path must pass through; repeatable, in order")
      ->allow_extra_args(false);
  options.converters.add_option(*command);
  command->add_flag("--json", options.json, "Print JSON");
  command->footer(
      "Example:\n  texremap path --from mitsuba/ward --to mitsuba/as\n"
      "  texremap path --from mitsuba/ward --to gltf");
}

}  // namespace remap
