// This file is `remapc chain` and `remapc invert`. They make a fit from other fits.
#include <iostream>

#include "build/build.hpp"
#include "build/fit_folder.hpp"
#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "fit/fit_table.hpp"
#include "lower/fit_file.hpp"
#include "lower/lower.hpp"
#include "remap/error.hpp"
#include "table/regression.hpp"

namespace remap {
namespace {

struct ChainCommand {
  std::vector<std::string> steps;  // for chain: files or ids
  std::string fit;                 // for invert: the fit to invert
  std::string id;
  std::filesystem::path fit_folder, output = "fits";
  bool force = false, json = false;
};

// Returns the path of the new fit, which must not exist.
std::filesystem::path new_path(const ChainCommand& command, const std::string& source,
                               const std::string& target) {
  const std::string id = command.id.empty() ? converter_id(source, target) : command.id;
  const std::filesystem::path path = command.output / (id + ".json");
  require_new(path, command.force);
  return path;
}

void run_chain(const ChainCommand& command) {
  std::vector<Fit> steps;
  for (const std::string& name : command.steps) steps.push_back(find_fit(name, command.fit_folder));
  const std::filesystem::path path = new_path(command, steps.front().source.model, steps.back().target.model);
  Fit chain = composed_fit(steps, command.id);
  add_converter(&chain);
  write_file(path, fit_to_json(chain));
  const std::string& steps_text = chain.method.at("against its steps one after another");
  if (command.json) {
    const Json json = {{"fit", path.string()},
                       {"id", chain.id},
                       {"domain",
                        {{"alpha", {chain.domain.alpha.min, chain.domain.alpha.max}},
                         {"specular", {chain.domain.specular.min, chain.domain.specular.max}}}},
                       {"alpha_error", figures_json(chain.alpha_error)},
                       {"specular_error", figures_json(chain.specular_error)},
                       {"against_its_steps", steps_text}};
    std::cout << json.dump(2) << "\n";
    return;
  }
  std::cerr << path.string() << ": chain of " << steps.size()
            << " fits\n  errors of the steps, propagated: " << errors_text(chain, "held out")
            << "\n  compared with its steps: " << steps_text << "\n";
}

void run_invert(const ChainCommand& command) {
  const Fit fit = find_fit(command.fit, command.fit_folder);
  const std::filesystem::path path = new_path(command, fit.target.model, fit.source.model);
  const std::string bytes = fit_to_json(fit);
  FitOptions options;
  options.id = command.id;
  const Table table = inverse_table(fit, bytes);
  Fit inverse = fit_table(table, table_text(table), options);
  add_converter(&inverse);
  write_file(path, fit_to_json(inverse));
  if (command.json) {
    const Json json = {{"fit", path.string()},
                       {"id", inverse.id},
                       {"inverse_of", fit.id},
                       {"kind", kind_name(inverse.mapping)},
                       {"alpha_error", figures_json(inverse.alpha_error)},
                       {"specular_error", figures_json(inverse.specular_error)}};
    std::cout << json.dump(2) << "\n";
    return;
  }
  std::cerr << path.string() << ": inverse of " << fit.id << "; "
            << errors_text(inverse, "held out from the exact inverse") << "\n";
}

void add_new_fit_options(Command& app, ChainCommand& command) {
  app.option_group("Input");
  add_fits_option(app, command.fit_folder, "Folder where ids are looked up");
  app.option_group("Output");
  app.add_option("-o,--output FOLDER", command.output, "Folder for the new fit");
  app.add_option("--id ID", command.id, "Id of the new fit (default: <source>_to_<target>)");
  add_force_flag(app, command.force);
  app.add_flag("--json", command.json, "Print a summary as JSON to standard output");
}

}  // namespace

void add_chain_command(Command& app) {
  Command* command = app.add_subcommand(
      "chain", "Compose several fits into one, whose header converts in a single pass", kCompileStage);
  ChainCommand& options = set_work<ChainCommand>(*command, run_chain);
  command->add_option("steps", options.steps, "Fits in order: files, or ids in the folder of fits")
      ->required();
  add_new_fit_options(*command, options);
  command->footer(
      "In the domain of the new fit, every step stays in its own domain. Its errors are the errors of the "
      "steps, "
      "propagated to the end.\n\n"
      "Example:\n"
      "  remapc chain mitsuba_ward_to_mitsuba_ggx mitsuba_ggx_to_cycles_2_7_ggx \\\n"
      "    -o mine");
}

void add_invert_command(Command& app) {
  Command* command = app.add_subcommand(
      "invert", "Fit the inverse of a fit: from its target's parameters to its source's", kCompileStage);
  ChainCommand& options = set_work<ChainCommand>(*command, run_invert);
  command->add_option("fit", options.fit, "Fit: file, or id in the folder of fits")->required();
  add_new_fit_options(*command, options);
  command->footer(
      "If the measured table is at hand, `remapc fit --swap` is closer to the measurement.\n\n"
      "Example:\n  remapc invert mitsuba_ggx_to_cycles_2_7_ggx -o mine");
}

}  // namespace remap
