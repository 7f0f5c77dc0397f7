// This file is `remapc fit`, which fits a table.
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <string_view>
#include <unistd.h>

#include "command_line/run_app.hpp"
#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "commands/share_progress.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "fit/fit_table.hpp"
#include "fit/network/fit_network.hpp"
#include "fit/parametric/parametric.hpp"
#include "lower/fit_file.hpp"
#include "lower/lower.hpp"
#include "report/fit_plot.hpp"
#include "table/regression.hpp"
#include "table/table.hpp"

namespace remap {
namespace {

// Larger values are most likely typing errors, because the networks of the paper have 300 units.
constexpr int kMostUnits = 4096, kMostStarts = 1000;

// `auto` comes before the names of the kinds. With it, pictures decide.
const auto kModels = [] {
  NamedValues<std::string_view, kFitKinds.size() + 1> models{{{"", "auto"}}};
  for (std::size_t i = 0; i < kFitKinds.size(); ++i) models[i + 1] = {kFitKinds[i], kFitKinds[i]};
  return models;
}();

struct FitCommand {
  TableInput table;
  FitOptions options;
  std::filesystem::path folder = "fits";
  std::filesystem::path plot;
  double tolerance = kLoweringTolerance;
  bool swap = false, force = false, json = false;
};

// Throws if the user gave options of one regression together with another regression.
void require_consistent(const FitCommand& command, const Command& app) {
  const std::string given(command.options.kind);
  const auto require_model = [&](const std::string& option, const std::string& model) {
    if (app.count(option) != 0 && !given.empty() && given != model)
      throw usage_error(option + " cannot be used with --model " + given + " (use " + model + " or auto)");
  };
  require_model("--form", "parametric");
  for (const std::string option : {"--layers", "--activation", "--starts"}) require_model(option, "mlp");
  has_pole(command.options.form);  // throws for an unknown form
}

void report(const FitCommand& command, const std::filesystem::path& path, const Fit& fit) {
  if (command.json) {
    Json json = {{"fit", path.string()},
                 {"id", fit.id},
                 {"kind", kind_name(fit.mapping)},
                 {"method", fit.method},
                 {"alpha_error", figures_json(fit.alpha_error)},
                 {"specular_error", figures_json(fit.specular_error)},
                 {"candidates", Json::list()}};
    for (const CandidateRecord& candidate : fit.candidates)
      json["candidates"].push_back(candidate_json(candidate));
    std::cout << json.dump(2) << "\n";
    return;
  }
  if (!fit.candidates.empty()) std::cerr << candidate_text(fit.candidates, fit.target.specular);
  std::cerr << path.string() << ": " << fit_label(fit) << ", " << fit.split.trained_rows << " rows; "
            << errors_text(fit, "held out") << "\n";
}

// Refuses a network that is too large for a fit file, before it is trained.
void require_layers(const std::vector<std::size_t>& hidden, std::size_t inputs, std::size_t outputs) {
  std::size_t width = inputs, numbers = 2 * (inputs + outputs);
  for (const std::size_t units : hidden) {
    numbers += units * (width + 1);
    width = units;
  }
  numbers += outputs * (width + 1);
  if (hidden.size() < kMostLayers && numbers <= kMostNetworkNumbers) return;
  throw usage_error("--layers: a network of " + counted(hidden.size(), "hidden layer") + " and " +
                    std::to_string(numbers) + " numbers is too large (at most " +
                    std::to_string(kMostLayers - 1) + " hidden layers and " +
                    std::to_string(kMostNetworkNumbers) + " numbers)");
}

// Refuses other options for a table of metallic materials. Only a network that converts specular to metallic
// can be fitted to it.
void require_material_options(const FitCommand& command) {
  if (!command.swap)
    throw usage_error(command.table.path +
                      ": converting metallic to specular needs no fit, because a formula is exact (use "
                      "--swap to fit the inverse)");
  if (const std::string model(command.options.kind); !model.empty() && model != "mlp")
    throw usage_error("--model " + model + ": not available for a table of materials (use mlp)");
  if (!command.plot.empty())
    throw usage_error("--plot: not available for a table of materials (remove this option)");
}

MaterialNetworkOptions network_options(const FitCommand& command, const Command& app) {
  const TrainingOptions& mlp = command.options.mlp;
  MaterialNetworkOptions options;
  options.id = command.options.id;
  if (app.count("--layers") != 0) options.hidden = mlp.hidden;
  if (app.count("--activation") != 0) options.activation = mlp.activation;
  if (app.count("--starts") != 0) options.starts = mlp.starts;
  if (app.count("--held-out") != 0) options.held_out_fraction = command.options.held_out_fraction;
  options.seed = command.options.seed;
  options.jobs = command.options.jobs;
  return options;
}

void report(const FitCommand& command, const std::filesystem::path& path, const WorkflowFit& fit) {
  const NetworkTraining& training = *fit.training;
  if (command.json) {
    const Json json = {{"fit", path.string()},
                       {"id", fit.id},
                       {"kind", material_kind(fit)},
                       {"method", training.method},
                       {"base_color_error", figures_json(training.base_color)},
                       {"metallic_error", figures_json(training.metallic)}};
    std::cout << json.dump(2) << "\n";
    return;
  }
  std::cerr << path.string() << ": " << training.method.at("network") << "; held out: base color rms "
            << error_text(training.base_color.rms) << ", metallic rms " << error_text(training.metallic.rms)
            << "\n";
}

// Throws kOutput if the folder of the fit cannot be written or created, before the work starts. Creates
// nothing. So if the table cannot be fitted, no empty folder remains.
void require_output_folder(const std::filesystem::path& folder) {
  std::filesystem::path existing = folder;
  while (existing.has_parent_path() && existing != existing.parent_path() &&
         !std::filesystem::exists(existing))
    existing = existing.parent_path();
  if (!std::filesystem::exists(existing)) existing = ".";
  if (!std::filesystem::is_directory(existing))
    throw output_error(folder.string() + ": cannot be a folder, because " + existing.string() +
                       " is a file (choose another folder)");
  if (::access(existing.c_str(), W_OK) != 0)
    throw output_error(folder.string() + ": cannot be written (" + existing.string() + " is read-only)");
}

// Returns the path of the fit. Neither the fit nor its plot may exist.
std::filesystem::path new_path(const FitCommand& command, const std::string& id) {
  const std::filesystem::path path = command.folder / (id + ".json");
  require_new(path, command.force);
  require_new(command.plot, command.force);
  return path;
}

void run_on(const MaterialTable& table, const std::string& bytes, const FitCommand& command,
            const Command& app) {
  require_material_options(command);
  LightMatch light = light_match(table.comments);
  light.accepted = light.accepted || command.options.accept_light;
  require_light(light, table.name);
  require_layers(command.options.mlp.hidden, 6, 4);
  require_output_folder(command.folder);
  new_path(command, command.options.id);
  const WorkflowFit fit = [&] {
    ShareProgress progress("fit", command.table.path);
    return fit_material_network(table, bytes, network_options(command, app), std::ref(progress));
  }();
  const std::filesystem::path path = new_path(command, fit.id);
  write_file(path, fit_to_json(fit));
  report(command, path, fit);
}

// Lowers the fit. If this fails, the fit is kept without a converter, because only texremap and headers need
// one.
void lower_if_possible(const FitCommand& command, Fit* fit) {
  try {
    add_converter(fit, command.tolerance);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kNumeric) throw;
    print_message("remapc",
                  "warning: " + fit->id +
                      ": texremap and remapc emit cannot use this fit, because it cannot be lowered (" +
                      error.what() + ")");
  }
}

void run_on(const Table& given, const std::string& bytes, const FitCommand& command, const Command&) {
  const Table table = command.swap ? swapped(given) : given;
  require_layers(command.options.mlp.hidden, 2, 1);
  require_output_folder(command.folder);
  const std::string& id = command.options.id;
  const std::filesystem::path path =
      new_path(command, id.empty() ? converter_id(table.source.model, table.target.model) : id);
  if (!command.plot.empty()) require_plot(command.plot);
  std::vector<Fit> compared;
  Fit fit = [&] {
    ShareProgress progress("fit", table.source.model + " -> " + table.target.model);
    try {
      return fit_table(table, bytes, command.options, std::ref(progress), &compared);
    } catch (const Error& error) {
      // Errors of a regression begin with its name, not with the table.
      if (!std::string_view(error.what()).starts_with(std::string(command.options.kind) + ": ")) throw;
      throw Error(error.kind(), table.name + ": " + error.what());
    }
  }();
  lower_if_possible(command, &fit);
  write_file(path, fit_to_json(fit));
  if (!command.plot.empty())
    write_plot(command.plot, table, compared.empty() ? std::vector<Fit>{fit} : compared);
  report(command, path, fit);
}

void run(const FitCommand& command, const Command& app) {
  require_consistent(command, app);
  std::string bytes;
  const AnyTable input = command.table.read_any(&bytes);
  std::visit([&](const auto& table) { run_on(table, bytes, command, app); }, input);
}

void add_regression_options(Command& app, FitCommand& command) {
  FitOptions& options = command.options;
  app.option_group("Regression");
  app.add_option("--model NAME", options.kind, one_of(kModels, "kind of fit"),
                 "auto: the shortest form whose pictures are as good as the best; parametric: polynomial and "
                 "exponentials of the paper; svr: support vectors; mlp: a small network")
      ->default_text("auto");
  app.add_flag("--swap", command.swap,
               "Fit the inverse, from the table's target to its source; with a table of metallic materials "
               "(remapc sample): a network from specular to metallic");
  app.option_group(kRareOptions);
  app.add_option("--form FORM", options.form, "Parametric: paper or paper+pole (default: paper)");
  app.add_option("--layers", options.mlp.hidden, "Network: units of each hidden layer, as 16,16")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->range(1, kMostUnits);
  app.add_option("--activation NAME", options.mlp.activation, one_of(kActivations, "activation function"),
                 "Network: activation function")
      ->default_text(std::string(activation_name(options.mlp.activation)));
  app.add_option("--starts", options.mlp.starts,
                 "Network: number of trainings; remapc keeps the best network")
      ->range(1, kMostStarts);
  app.add_option("--held-out", options.held_out_fraction, "Fraction of the rows held out to measure errors");
  app.add_option(
         "--lower TOLERANCE", command.tolerance,
         "Largest allowed deviation of the converter from the fit: absolute for target alpha, relative to "
         "the largest value for target specular")
      ->positive();
  app.add_option("--seed", options.seed, "Seed of the split and all other random choices")
      ->range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max());
  app.add_option("--jobs", options.jobs, "Threads, 0: one per core; the fit does not depend on it");
}

void add_output_options(Command& app, FitCommand& command) {
  app.option_group("Output");
  app.add_option("-o,--output FOLDER", command.folder, "Folder for the fit, <id>.json");
  app.add_option("--id ID", command.options.id, "Id of the fit (default: <source>_to_<target>)");
  app.add_option("--plot FILE", command.plot,
                 "Plot rows, fits and residuals to this file, SVG or PNG by its name (needs gnuplot)");
  add_force_flag(app, command.force);
  app.add_flag("--json", command.json, "Print a summary as JSON to standard output");
}

}  // namespace

void add_fit_command(Command& app) {
  Command* command = app.add_subcommand("fit", "Fit a table and write <id>.json", kFitStage);
  FitCommand& options =
      set_work<FitCommand>(*command, [command](const FitCommand& given) { run(given, *command); });
  options.table.add_options(*command);
  add_accept_light_flag(*command, options.options.accept_light);
  add_output_options(*command, options);
  add_regression_options(*command, options);
  command->footer("Example:\n  remapc fit ward_to_as.csv -o fits --plot fits/ward_to_as.svg");
}

}  // namespace remap
