// `texremap list`: the converters with the result of their self-tests, their models, or the workflows.
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>

#include "command_line/command.hpp"
#include "remap/error.hpp"
#include "remap/path.hpp"
#include "remap/shipped_converters.hpp"
#include "remap/workflow_models.hpp"
#include "texremap/commands.hpp"
#include "texremap/converter_text.hpp"
#include "texremap/converters_option.hpp"

namespace remap {
namespace {

struct ListOptions {
  bool models = false;
  bool workflows = false;
  bool json = false;
};

Json converter_json(const Converter& converter) {
  const ConverterInfo& info = converter.info();
  return {{"id", info.id},
          {"source", side_json(info.source)},
          {"target", side_json(info.target)},
          {"domain", domain_json(info)},
          {"rms_error", errors_json(info)},
          {"instructions", std::string(instruction_set_name(info.instructions))},
          {"self_test", converter.self_test()}};
}

void print_converter(const Converter& converter) {
  const ConverterInfo& info = converter.info();
  std::cout << info.id << '\n'
            << "  from   " << info.source.model << ", " << domain_text(info) << '\n'
            << "  to     " << info.target.model << ", " << convention_name(info.target.roughness) << " and "
            << info.target.specular << '\n'
            << "  error  " << errors_text(info) << '\n'
            << "  test   " << (converter.self_test() ? "passed" : "FAILED") << " with "
            << instruction_set_name(info.instructions) << " instructions\n";
}

void list_converters(const ListOptions& options) {
  Json all = Json::array();
  std::string failed;
  for (const auto& converter : shipped_converters()) {
    if (options.json)
      all.push_back(converter_json(*converter));
    else
      print_converter(*converter);
    if (!converter->self_test()) failed += (failed.empty() ? "" : ", ") + converter->info().id;
  }
  if (options.json) std::cout << all.dump(2) << '\n';
  if (!failed.empty())
    throw Error(ErrorKind::kNumeric, failed + ": self-test failed (results would be wrong)");
}

// The two parameters of a model, as given by a converter from or to it.
ModelSide side_of(const std::string& model) {
  for (const auto& converter : shipped_converters()) {
    if (converter->info().source.model == model) return converter->info().source;
    if (converter->info().target.model == model) return converter->info().target;
  }
  return {};
}

void list_models(const ListOptions& options) {
  const ConverterGraph graph = shipped_graph();
  Json all = Json::array();
  for (const std::string& model : graph.models()) {
    Json entry = side_json(side_of(model));
    entry["reaches"] = Json::array();
    if (!options.json)
      std::cout << model << '\n'
                << "  takes    " << entry["roughness"].get<std::string>() << " and "
                << entry["specular"].get<std::string>() << '\n';
    for (const std::string& target : graph.reachable_from(model)) {
      const ConverterPath path = graph.find_paths({model, target, {}}).front();
      if (options.json)
        entry["reaches"].push_back(
            {{"model", target}, {"path", path_json(path)}, {"expected_error", path.expected_error}});
      else
        std::cout << "  reaches  " << target << ", expected error " << expected_text(path.expected_error)
                  << (path.steps.size() > 1 ? ", in " + std::to_string(path.steps.size()) + " steps" : "")
                  << '\n';
    }
    all.push_back(entry);
  }
  if (options.json) std::cout << all.dump(2) << '\n';
}

Json workflow_json(const WorkflowModel& model) {
  Json json = {{"model", model_of(model.end)},
               {"workflow", workflow_kind_name(kind_of(model.end))},
               {"diffuse", diffuse_convention_name(diffuse_of(model.end))},
               {"dielectric_f0", Json()},
               {"width", convention_name(width_of(model.end))},
               {"brdf", model.brdf},
               {"conventions_known", model.conventions_known},
               {"reason", model.reason}};
  if (const auto* metallic = std::get_if<MetallicWorkflow>(&model.end))
    json["dielectric_f0"] = metallic->dielectric_f0;
  return json;
}

void print_workflow(const WorkflowModel& model) {
  const auto* metallic = std::get_if<MetallicWorkflow>(&model.end);
  std::cout << model_of(model.end) << '\n'
            << "  takes    " << (metallic != nullptr ? "base color, metallic and " : "diffuse, specular and ")
            << convention_name(width_of(model.end)) << '\n'
            << "  diffuse  " << diffuse_convention_name(diffuse_of(model.end));
  if (metallic != nullptr) std::cout << ", dielectric F0 " << metallic->dielectric_f0;
  std::cout << (model.conventions_known ? "" : " (assumed)") << '\n'
            << "  over     " << model.brdf << '\n'
            << "  because  " << model.reason << '\n';
}

void list_workflows(const ListOptions& options) {
  Json all = Json::array();
  for (const WorkflowModel& model : workflow_models()) {
    if (options.json)
      all.push_back(workflow_json(model));
    else
      print_workflow(model);
  }
  if (options.json) std::cout << all.dump(2) << '\n';
}

}  // namespace

void add_list_command(Command& app) {
  auto options = std::make_shared<ListOptions>();
  Command* command = app.add_subcommand("list", "List the converters, their models, or the workflows");
  command->add_flag("--models", options->models, "List the models, and the models that each one reaches");
  command->add_flag("--workflows", options->workflows,
                    "List the named workflows with their conventions. `convert` combines other models with a "
                    "workflow by --from-workflow and --to-workflow");
  add_converters_option(*command);
  command->add_flag("--json", options->json, "Print JSON");
  command->footer("Example:\n  texremap list --json\n  texremap list --workflows");
  command->callback([options] {
    if (options->workflows) return list_workflows(*options);
    options->models ? list_models(*options) : list_converters(*options);
  });
}

}  // namespace remap
