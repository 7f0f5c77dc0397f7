// This file is `remapc renderers`, which lists the external renderers that work here, and their models.
#include <iomanip>
#include <iostream>

#include "command_line/progress.hpp"
#include "commands/commands.hpp"
#include "core/json.hpp"
#include "remap/error.hpp"
#include "table/regression.hpp"
#include "worker/renderer_set.hpp"

namespace remap {
namespace {

struct RenderersCommand {
  RendererOptions renderers;
  bool json = false;
};

Json model_json(const ModelDescription& model) {
  Json parameters;
  for (const ParameterDescription& parameter : model.parameters) {
    parameters[parameter.name] = {{"role", role_word(parameter.role)},
                                  {"range", {parameter.range.min, parameter.range.max}}};
    if (parameter.role == ParameterRole::kRoughness)
      parameters[parameter.name]["convention"] = encoding_name(model.roughness);
    if (parameter.role == ParameterRole::kOther) parameters[parameter.name]["default"] = parameter.standard;
  }
  return {{"model", model.name},
          {"noise", model.noise},
          {"textures", model.textures},
          {"parameters", parameters}};
}

void print_model(const ModelDescription& model) {
  std::cout << "  " << std::left << std::setw(28) << model.name;
  for (const ParameterDescription& parameter : model.parameters)
    std::cout << "  " << parameter.name << " " << range_text(parameter.range);
  std::cout << (model.noise ? "  (noise)" : "") << (model.textures ? "  (textures)" : "") << "\n";
}

void run(const RenderersCommand& command) {
  watch_interruptions();
  WorkerSettings settings = worker_settings(command.renderers);
  settings.processes = 1;
  Json list = Json::list();
  for (const WorkerEntry& entry : known_workers(command.renderers.workers)) {
    try {
      const WorkerRenderer renderer(entry, settings);
      Json models = Json::list();
      if (!command.json) std::cout << entry.name << ": " << renderer.version() << "\n";
      for (const ModelDescription& model : renderer.models()) {
        models.push_back(model_json(model));
        if (!command.json) print_model(model);
      }
      list.push_back({{"name", entry.name}, {"version", renderer.version()}, {"models", models}});
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
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

void add_renderers_command(Command& app) {
  Command* command = app.add_subcommand(
      "renderers", "List the external renderers on this machine: versions, models, parameters",
      kRendererStage);
  RenderersCommand& options = set_work<RenderersCommand>(*command, run);
  command->option_group("Output");
  command->add_flag("--json", options.json,
                    "Print the list as JSON to standard output, with reasons for missing renderers");
  add_renderer_options(*command, options.renderers);
  command->footer("Example:\n  remapc renderers");
}

}  // namespace remap
