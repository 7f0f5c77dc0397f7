// `remapc renderers` lists the external renderers that work on this machine, and their models.
#include <iomanip>
#include <iostream>

#include "command_line/interruption.hpp"
#include "commands/commands.hpp"
#include "commands/renderer_options.hpp"
#include "remap/error.hpp"
#include "table/domain.hpp"
#include "text/json.hpp"
#include "worker/renderer_set.hpp"

namespace remapc {
namespace {

struct RenderersCommand {
  RendererOptions renderers;
  bool json = false;
};

remap::Json model_json(const ModelDescription& model) {
  remap::Json parameters;
  for (const ParameterDescription& parameter : model.parameters) {
    parameters[parameter.name] = {{"role", role_word(parameter.role)},
                                  {"range", {parameter.range.min, parameter.range.max}}};
    if (parameter.role == ParameterRole::kRoughness)
      parameters[parameter.name]["convention"] = remap::convention_name(model.roughness);
    if (parameter.role == ParameterRole::kOther) parameters[parameter.name]["default"] = parameter.standard;
  }
  return {{"model", model.name}, {"noise", model.noise}, {"parameters", parameters}};
}

void print_model(const ModelDescription& model) {
  std::cout << "  " << std::left << std::setw(28) << model.name;
  for (const ParameterDescription& parameter : model.parameters)
    std::cout << "  " << parameter.name << " " << range_text(parameter.range);
  std::cout << (model.noise ? "  (noise)" : "") << "\n";
}

void run(const RenderersCommand& command) {
  remap::watch_interruptions();
  WorkerSettings settings = worker_settings(command.renderers);
  settings.processes = 1;
  remap::Json list = remap::Json::list();
  for (const WorkerEntry& entry : known_workers(command.renderers.workers)) {
    try {
      const WorkerRenderer renderer(entry, settings);
      remap::Json models = remap::Json::list();
      if (!command.json) std::cout << entry.name << ": " << renderer.version() << "\n";
      for (const ModelDescription& model : renderer.models()) {
        models.push_back(model_json(model));
        if (!command.json) print_model(model);
      }
      list.push_back({{"name", entry.name}, {"version", renderer.version()}, {"models", models}});
    } catch (const remap::Error& error) {
      if (error.kind() != remap::ErrorKind::kInput) throw;
      list.push_back({{"name", entry.name}, {"missing", error.what()}, {"install", entry.install}});
      if (command.json) continue;
      if (entry.install.empty())
        std::cout << entry.name << ": " << error.what() << "\n";
      else
        std::cout << entry.name << ": not installed (install it with: " << entry.install << ")\n";
    }
  }
  if (command.json) std::cout << list.dump(2) << "\n";
}

}  // namespace

void add_renderers_command(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "renderers", "List the external renderers on this machine: versions, models, parameters",
      kRendererStage);
  RenderersCommand& options = set_work<RenderersCommand>(*command, run);
  command->option_group("Output");
  command->add_flag("--json", options.json,
                    "Print the list as JSON to standard output, with reasons for missing renderers");
  add_renderer_options(*command, options.renderers);
  command->footer("Example:\n  remapc renderers");
}

}  // namespace remapc
