// This file is `texremap list`. It lists the names for --from and --to, converters with their self-tests,
// models and workflows.
#include <iostream>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "command_line/help_text.hpp"
#include "converter/converter_data.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "paths/known_names.hpp"
#include "remap/conversion.hpp"
#include "remap/path.hpp"
#include "remap/workflow.hpp"
#include "texremap/commands/commands.hpp"
#include "texremap/options/used_converters.hpp"
#include "texremap/plan/converter_text.hpp"

namespace remap {
namespace {

struct ListOptions {
  bool pairs = false;
  bool models = false;
  bool workflows = false;
  bool json = false;
  UsedConverters converters;
};

// Returns a shipped converter, which is the only step of `path`, as JSON.
Json converter_json(const ConverterPath& path, const std::optional<ConverterPath>& closer) {
  const Converter& converter = *path.steps.front();
  const ConverterInfo& info = converter.info();
  Json json = {{"id", info.id},
               {"source", side_json(info.source)},
               {"target", side_json(info.target)},
               {"domain", domain_json(info)},
               {"rms_error", errors_json(info)},
               {"ssim", ssim_json(info)},
               {"expected_error", path.expected_error},
               {"instructions", std::string(instruction_set_name(info.instructions))},
               {"self_test", converter.self_test()}};
  json.update(pictures_json(path, closer));
  return json;
}

void print_converter(const ConverterPath& path, const std::optional<ConverterPath>& closer) {
  const Converter& converter = *path.steps.front();
  const ConverterInfo& info = converter.info();
  std::cout << info.id << '\n'
            << "  from   " << info.source.model << ", " << domain_text(info) << '\n'
            << "  to     " << info.target.model << ", " << encoding_name(info.target.roughness) << " and "
            << info.target.specular << '\n'
            << "  test   " << (converter.self_test() ? "passed" : "FAILED") << " with "
            << instruction_set_name(info.instructions) << " instructions\n";
  std::cout << "  note   " << difference_text(path) << '\n';
  if (closer) std::cout << "  note   " << closer_text(*closer) << '\n';
}

void list_converters(const ListOptions& options) {
  const ConverterGraph graph = options.converters.graph();
  Json all = Json::list();
  std::string failed;
  for (const Converter* converter : graph.converters()) {
    const ConverterInfo& info = converter->info();
    const ConverterPath path{{converter}, expected_error(info)};
    const auto closer =
        closer_path(path, graph.paths_to_renderer({info.source.model, renderer_of(info.target.model), {}}));
    if (options.json)
      all.push_back(converter_json(path, closer));
    else
      print_converter(path, closer);
    if (!converter->self_test()) failed += (failed.empty() ? "" : ", ") + converter->info().id;
  }
  if (options.json) std::cout << all.dump(2) << '\n';
  if (!failed.empty()) throw numeric_error(failed + ": self-test failed (results would be wrong)");
}

Json reached_json(const ConverterPath& path, const std::optional<ConverterPath>& closer) {
  Json json = {
      {"model", target_model(path)}, {"path", path_json(path)}, {"expected_error", path.expected_error}};
  json.update(pictures_json(path, closer));
  return json;
}

void print_reached(const ConverterPath& path, const std::optional<ConverterPath>& closer) {
  std::cout << "  reaches  " << target_model(path) << ", " << difference_text(path);
  if (path.steps.size() > 1) std::cout << ", in " << path.steps.size() << " steps";
  if (closer) std::cout << "; " << closer_text(*closer);
  std::cout << '\n';
}

void list_models(const ListOptions& options) {
  const ConverterGraph graph = options.converters.graph();
  Json all = Json::list();
  for (const std::string& model : graph.models()) {
    const ModelSide side = graph.side_of(model);
    Json entry = side_json(side);
    entry["reaches"] = Json::list();
    if (!options.json)
      std::cout << model << '\n'
                << "  takes    " << encoding_name(side.roughness) << " and " << side.specular << '\n';
    std::vector<ConverterPath> paths;
    for (const std::string& target : graph.reachable_from(model))
      paths.push_back(graph.find_paths({model, target, {}}).front());
    for (const ConverterPath& path : paths) {
      const std::optional<ConverterPath> closer = closer_path(path, paths);
      if (options.json)
        entry["reaches"].push_back(reached_json(path, closer));
      else
        print_reached(path, closer);
    }
    all.push_back(entry);
  }
  if (options.json) std::cout << all.dump(2) << '\n';
}

Json workflow_json(const WorkflowModel& model) {
  Json json = {{"model", model_of(model.end)},
               {"workflow", kind_name(model.end)},
               {"diffuse", diffuse_convention_name(diffuse_of(model.end))},
               {"dielectric_f0", Json()},
               {"width", encoding_name(width_of(model.end))},
               {"brdf", model.brdf},
               {"conventions_known", model.conventions_known},
               {"reason", model.reason}};
  if (const auto* metallic = std::get_if<MetallicWorkflow>(&model.end))
    json["dielectric_f0"] = metallic->dielectric_f0;
  json["aliases"] = Json::list();
  for (const ModelAlias& alias : model_aliases())
    if (alias.model == model_of(model.end))
      json["aliases"].push_back({{"name", alias.name}, {"meaning", alias.meaning}});
  return json;
}

void print_workflow(const WorkflowModel& model) {
  const auto* metallic = std::get_if<MetallicWorkflow>(&model.end);
  std::cout << model_of(model.end) << '\n'
            << "  takes    " << (metallic != nullptr ? "base color, metallic and " : "diffuse, specular and ")
            << encoding_name(width_of(model.end)) << '\n'
            << "  diffuse  " << diffuse_convention_name(diffuse_of(model.end));
  if (metallic != nullptr) std::cout << ", dielectric F0 " << metallic->dielectric_f0;
  std::cout << (model.conventions_known ? "" : " (assumed)") << '\n'
            << "  BRDF     " << model.brdf << '\n'
            << "  because  " << model.reason << '\n';
  const char* title = "  also     ";
  for (const ModelAlias& alias : model_aliases()) {
    if (alias.model != model_of(model.end)) continue;
    std::cout << title << alias.name << ": " << alias.meaning << '\n';
    title = "           ";
  }
}

void list_workflows(const ListOptions& options) {
  Json all = Json::list();
  for (const WorkflowModel& model : workflow_models()) {
    if (options.json)
      all.push_back(workflow_json(model));
    else
      print_workflow(model);
  }
  if (options.json) std::cout << all.dump(2) << '\n';
}

void print_names(const char* heading, std::span<const KnownName> names) {
  constexpr std::size_t kTitle = 32, kWord = 18;
  std::cout << heading << '\n';
  for (const auto& [title, word] : names) {
    const std::string model = model_named(std::string(word)).name;
    std::cout << "  " << padded(std::string(title), kTitle)
              << (model == word ? std::string(word) : padded(std::string(word), kWord) + model) << '\n';
  }
}

// Prints the models of each renderer on one line.
void print_renderers(const std::vector<std::string>& models) {
  std::string line, renderer;
  for (const std::string& model : models) {
    if (renderer_of(model) == renderer) {
      line += ", " + model.substr(renderer.size() + 1);
      continue;
    }
    if (!line.empty()) std::cout << wrapped(line, 4) << '\n';
    renderer = renderer_of(model);
    line = "  " + model;
  }
  if (!line.empty()) std::cout << wrapped(line, 4) << '\n';
}

void list_names(const ListOptions& options) {
  const std::vector<std::string> models = options.converters.graph().models();
  if (options.json) {
    const Json names = {{"programs", names_json(known_programs())},
                        {"formats", names_json(known_formats())},
                        {"models", models}};
    std::cout << names.dump(2) << '\n';
    return;
  }
  print_names("Programs: name for --from and --to (and its model, if the names differ)", known_programs());
  print_names("\nFile formats", known_formats());
  std::cout << "\nRenderers and research models\n";
  print_renderers(models);
}

void list(const ListOptions& options) {
  if (options.workflows) return list_workflows(options);
  if (options.models) return list_models(options);
  options.pairs ? list_converters(options) : list_names(options);
}

}  // namespace

void add_list_command(Command& app) {
  Command* command = app.add_subcommand("list", "List the names for --from and --to");
  ListOptions& options = set_work<ListOptions>(*command, list);
  command->add_flag(
      "--pairs", options.pairs,
      "List the converters instead: their ranges, how far pictures differ, and their self-tests");
  command->add_flag("--models", options.models, "List the models, and the models that each one reaches");
  command->add_flag("--workflows", options.workflows,
                    "List the named workflows with their conventions. Other models get a workflow before "
                    "their name, such as --from specular:mitsuba/ward");
  options.converters.add_option(*command);
  command->add_flag("--json", options.json, "Print JSON");
  command->footer("Example:\n  texremap list\n  texremap list --pairs --json");
}

}  // namespace remap
