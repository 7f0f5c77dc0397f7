// This file is `remapc list`, which prints the fits of a folder or the built-in models.
#include <iomanip>
#include <iostream>

#include "build/fit_folder.hpp"
#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "renderer/renderer.hpp"
#include "table/regression.hpp"

namespace remap {
namespace {

struct ListOptions {
  std::filesystem::path fit_folder;
  bool models = false, json = false;
};

void list_models(bool json) {
  Json list = Json::list();
  for (const ModelDescription& model : make_builtin_renderer()->models()) {
    Json parameters;
    std::string text;
    for (const ParameterDescription& parameter : model.parameters) {
      parameters[parameter.name] = {parameter.range.min, parameter.range.max};
      text += "  " + parameter.name + " " + range_text(parameter.range);
    }
    list.push_back(
        {{"model", model.name}, {"roughness", encoding_name(model.roughness)}, {"parameters", parameters}});
    if (!json) std::cout << std::left << std::setw(26) << model.name << text << "\n";
  }
  if (json) std::cout << list.dump(2) << "\n";
}

void list_fits(const ListOptions& options) {
  Json list = Json::list();
  const auto add = [&](const Json& fit, const std::string& text) {
    list.push_back(fit);
    if (!options.json)
      std::cout << std::left << std::setw(40) << *fit.find("id")->text() << " " << std::setw(11)
                << *fit.find("kind")->text() << text << "\n";
  };
  const FitFolder folder = load_fit_folder(options.fit_folder);
  for (const Fit& fit : folder.fits)
    add({{"id", fit.id},
         {"source", fit.source.model},
         {"target", fit.target.model},
         {"kind", kind_name(fit.mapping)},
         {"alpha_rms_error", fit.alpha_error.rms},
         {"specular_rms_error", fit.specular_error.rms}},
        errors_text(fit, "held out"));
  for (const WorkflowFit& fit : folder.workflows) {
    const std::string formula(formula_name(fit.conversion.formula));
    add({{"id", fit.id},
         {"source", fit.conversion.source_model()},
         {"target", fit.conversion.target_model()},
         {"kind", material_kind(fit)},
         {"formula", formula}},
        formula + ", whole materials");
  }
  for (const WarpMapFit& fit : folder.warps)
    add({{"id", fit.id},
         {"source", fit.source_model},
         {"target", fit.template_model},
         {"kind", kWarpKind},
         {"copy_rms_error", fit.copy_rms_error}},
        "appearance warp of whole materials" +
            (fit.copy_rms_error < 0.0 ? "" : "; " + percent(fit.copy_rms_error) + " from an exact copy"));
  if (list.empty()) std::cerr << options.fit_folder.string() << ": no fits (*.json) in this folder\n";
  if (options.json) std::cout << list.dump(2) << "\n";
}

}  // namespace

void add_list_command(Command& app) {
  Command* command =
      app.add_subcommand("list", "List the fits of a folder, or the built-in models", kLookStage);
  ListOptions& options = set_work<ListOptions>(
      *command, [](const ListOptions& given) { given.models ? list_models(given.json) : list_fits(given); });
  command->option_group("Input");
  command->add_flag("--models", options.models,
                    "List the models of the built-in renderer and their parameters");
  add_fits_option(*command, options.fit_folder, "Folder of fits");
  command->option_group("Output");
  command->add_flag("--json", options.json, "Print the list as JSON to standard output");
  command->footer("Example:\n  remapc list --models");
}

}  // namespace remap
