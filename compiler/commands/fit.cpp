// `remapc fit`: a table to a fit.
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>

#include <nlohmann/json.hpp>

#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/table_input.hpp"
#include "fit/fit_table.hpp"
#include "fit/network/material_network.hpp"
#include "fit/parametric/parametric_form.hpp"
#include "fit/rows/split.hpp"
#include "fit_file/fit_json.hpp"
#include "remap/error.hpp"
#include "report/fit_plot.hpp"
#include "system/files.hpp"
#include "table/check.hpp"
#include "table/domain.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

// More is a slip of the finger: the networks of the paper have 300 units.
constexpr int kMostUnits = 4096, kMostStarts = 1000;

struct FitCommand {
  TableInput table;
  FitOptions options;
  std::string model = "auto";
  std::string activation = "tanh";
  std::filesystem::path folder = "fits";
  std::filesystem::path plot;
  bool swap = false;
  bool json = false;
};

// Options that say how a regression is done, where another was asked for, are mistakes.
void require_consistent(const FitCommand& command, const CLI::App& app) {
  const auto require_model = [&](const std::string& option, const std::string& model) {
    if (app.count(option) != 0 && command.model != "auto" && command.model != model)
      throw Error(ErrorKind::kUsage,
                  option + ": is for --model " + model + " or auto; found --model " + command.model);
  };
  require_model("--form", "parametric");
  for (const std::string option : {"--layers", "--activation", "--starts"}) require_model(option, "mlp");
  if (!command.options.regression.form.empty()) find_form(command.options.regression.form);
}

FitOptions fit_options(const FitCommand& command) {
  FitOptions options = command.options;
  if (command.model == "parametric") options.regressor = Regressor::kParametric;
  if (command.model == "svr") options.regressor = Regressor::kSvr;
  if (command.model == "mlp") options.regressor = Regressor::kMlp;
  options.regression.mlp.activation = *remap::activation_from_name(command.activation);
  return options;
}

FittedTable fit_with_progress(const Table& table, std::string_view bytes, const FitOptions& options) {
  constexpr double kUnits = 1000.0;
  remap::watch_interruptions();
  remap::Progress progress("fit " + table.source.model + " -> " + table.target.model,
                           static_cast<std::size_t>(kUnits));
  return fit_table(table, bytes, options, [&](double share) {
    if (remap::interruption()) throw Error(ErrorKind::kInterrupted, "fit: interrupted; nothing was written");
    progress.advance_to(static_cast<std::size_t>(kUnits * share));
  });
}

void report(const FitCommand& command, const std::filesystem::path& path, const remap::Fit& fit) {
  if (command.json) {
    nlohmann::ordered_json json = {{"fit", path.string()},
                                   {"id", fit.id},
                                   {"kind", kind_name(fit.mapping)},
                                   {"method", fit.method},
                                   {"alpha_error", figures_json(fit.roughness_error)},
                                   {"specular_error", figures_json(fit.specular_error)},
                                   {"candidates", nlohmann::json::array()}};
    for (const remap::Candidate& candidate : fit.candidates)
      json["candidates"].push_back(candidate_json(candidate));
    std::cout << json.dump(2) << "\n";
    return;
  }
  if (!fit.candidates.empty()) std::cerr << candidate_text(fit.candidates, fit.target.specular);
  std::cerr << path.string() << ": " << fit_label(fit) << ", " << fit.split.trained_rows << " rows; "
            << errors_text(fit, "held out") << "\n";
}

// Of whole materials there is one way back and one kind: equation (2) needs no fit.
void require_material_options(const FitCommand& command) {
  if (!command.swap)
    throw Error(ErrorKind::kUsage, command.table.path +
                                       ": from metallic to specular equation (2) is exact and needs no fit; "
                                       "expected --swap, for the way back");
  if (command.model != "auto" && command.model != "mlp")
    throw Error(ErrorKind::kUsage,
                "--model " + command.model + ": whole materials are fitted by a network; expected mlp");
  if (!command.plot.empty())
    throw Error(ErrorKind::kUsage, "--plot: draws width and specular; expected a table of these");
}

MaterialNetworkOptions network_options(const FitCommand& command, const CLI::App& app) {
  const MlpOptions& mlp = command.options.regression.mlp;
  MaterialNetworkOptions options;
  options.id = command.options.id;
  if (app.count("--layers") != 0) options.hidden = mlp.hidden;
  if (app.count("--activation") != 0) options.activation = *remap::activation_from_name(command.activation);
  if (app.count("--starts") != 0) options.starts = mlp.starts;
  if (app.count("--held-out") != 0) options.held_out_fraction = command.options.held_out_fraction;
  options.seed = command.options.regression.seed;
  options.jobs = command.options.regression.jobs;
  return options;
}

void run_on_materials(const FitCommand& command, const CLI::App& app, const std::string& bytes) {
  require_material_options(command);
  remap::create_parent(command.folder / "fit.json");
  const MaterialTable table = parse_material_table(bytes, command.table.path);
  constexpr double kUnits = 1000.0;
  remap::watch_interruptions();
  remap::WorkflowFit fit;
  {
    remap::Progress progress("fit " + command.table.path, static_cast<std::size_t>(kUnits));
    fit = fit_material_network(table, bytes, network_options(command, app), [&](double share) {
      if (remap::interruption())
        throw Error(ErrorKind::kInterrupted, "fit: interrupted; nothing was written");
      progress.advance_to(static_cast<std::size_t>(kUnits * share));
    });
  }
  const std::filesystem::path path = command.folder / (fit.id + ".json");
  remap::write_file(path, fit_to_json(fit));
  if (command.json) {
    const nlohmann::ordered_json json = {{"fit", path.string()},
                                         {"id", fit.id},
                                         {"kind", material_kind(fit)},
                                         {"method", fit.training->method},
                                         {"base_color_error", figures_json(fit.training->base_color)},
                                         {"metallic_error", figures_json(fit.training->metallic)}};
    std::cout << json.dump(2) << "\n";
    return;
  }
  std::cerr << path.string() << ": " << fit.training->method.at("network") << "; held out: base color rms "
            << error_text(fit.training->base_color.rms) << ", metallic rms "
            << error_text(fit.training->metallic.rms) << "\n";
}

void run(const FitCommand& command, const CLI::App& app) {
  require_consistent(command, app);
  if (const std::string text = remap::read_file(command.table.path);
      is_material_table(text, command.table.path)) {
    run_on_materials(command, app, text);
    return;
  }
  std::string bytes;
  Table table = command.table.read(&bytes);
  if (command.swap) table = swapped(table);
  // Outputs first: auto works for a minute.
  require_fittable(table);
  remap::create_parent(command.folder / "fit.json");
  if (!command.plot.empty()) require_plot(command.plot);
  const FittedTable fitted = fit_with_progress(table, bytes, fit_options(command));
  const std::filesystem::path path = command.folder / (fitted.fit.id + ".json");
  remap::write_file(path, fit_to_json(fitted.fit));
  if (!command.plot.empty())
    write_plot(command.plot, table,
               fitted.compared.empty() ? std::vector<remap::Fit>{fitted.fit} : fitted.compared);
  report(command, path, fitted.fit);
}

void add_regression_options(CLI::App& app, FitCommand& command) {
  RegressionOptions& regression = command.options.regression;
  app.add_option(
         "--model", command.model,
         "auto: the simplest of the others that is as good as the best by cross-validation, which "
         "takes up to a minute; parametric: polynomials and exponentials; svr: support vectors; mlp: a "
         "small network")
      ->check(CLI::IsMember({"auto", "parametric", "svr", "mlp"}))
      ->capture_default_str();
  app.add_option(
      "--form", regression.form,
      "Of the parametric kind: paper, paper+pole or ROUGHNESS/SPECULAR, see below; default: chosen");
  app.add_option("--layers", regression.mlp.hidden, "Of the network: units of each hidden layer, as 16,16")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(1, kMostUnits))
      ->capture_default_str();
  app.add_option("--activation", command.activation, "Of the network: relu, tanh or silu")
      ->check(CLI::IsMember(remap::activation_names()))
      ->capture_default_str();
  app.add_option("--starts", regression.mlp.starts, "Of the network: trainings of which the best is kept")
      ->check(CLI::Range(1, kMostStarts))
      ->capture_default_str();
  app.add_option("--seed", regression.seed, "Of the split, of folds, and of all other draws")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
  app.add_option("--jobs", regression.jobs, "Threads; 0: one a core. The fit does not depend on it")
      ->capture_default_str();
}

}  // namespace

void add_fit_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("fit", "Fit a table and write <id>.json");
  auto options = std::make_shared<FitCommand>();
  options->table.add_options(*command);
  add_regression_options(*command, *options);
  command->add_flag(
      "--swap", options->swap,
      "Fit the way back: the table's target becomes the source, and its source the target; of a table "
      "of whole metallic materials (remapc sample) a network from specular to metallic");
  command->add_option("--id", options->options.id, "Name of the converter; default: <source>_to_<target>");
  command
      ->add_option("--held-out", options->options.held_out_fraction, "Share of the rows that judges the fit")
      ->capture_default_str();
  command->add_option("-o,--output", options->folder, "Folder for the fit")->capture_default_str();
  command->add_option("--plot", options->plot, "Also draw rows, fits and residuals into this SVG (gnuplot)");
  command->add_flag("--json", options->json, "Summary as JSON on standard output");
  command->footer(form_list() + "Example:\n  remapc fit ward_to_as.csv -o fits --plot fits/ward_to_as.svg");
  command->callback([options, command] { run(*options, *command); });
}

}  // namespace remapc
