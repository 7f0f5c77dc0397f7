// `remapc fit`: a table to a fit.
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "commands/table_input.hpp"
#include "files.hpp"
#include "fit/fit_table.hpp"
#include "model/fit_json.hpp"
#include "number_text.hpp"

namespace remapc {
namespace {

struct FitCommand {
  TableInput table;
  FitOptions options;
  std::string model = "parametric";
  std::filesystem::path folder = "fits";
  bool json = false;
};

nlohmann::ordered_json figures_json(const remap::ErrorFigures& figures) {
  return {{"rms", figures.rms}, {"p99", figures.p99}, {"max", figures.max}};
}

void run(const FitCommand& command) {
  std::string bytes;
  const Table table = command.table.read(&bytes);
  const remap::Fit fit = fit_table(table, bytes, command.options);
  const std::filesystem::path path = command.folder / (fit.id + ".json");
  remap::write_file(path, fit_to_json(fit));
  if (command.json) {
    const nlohmann::ordered_json json = {{"fit", path.string()},
                                         {"id", fit.id},
                                         {"alpha_error", figures_json(fit.roughness_error)},
                                         {"specular_error", figures_json(fit.specular_error)}};
    std::cout << json.dump(2) << "\n";
    return;
  }
  const auto digits = [](double value) { return remap::number_text(remap::rounded_up(value, 2)); };
  std::cerr << path.string() << ": " << kind_name(fit.mapping) << ", " << fit.split.trained_rows
            << " rows; on " << fit.split.held_out_rows << " held out: alpha rms "
            << digits(fit.roughness_error.rms) << " max " << digits(fit.roughness_error.max) << ", "
            << fit.target.specular << " rms " << digits(fit.specular_error.rms) << " max "
            << digits(fit.specular_error.max) << "\n";
}

}  // namespace

void add_fit_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("fit", "Fit a table and write <id>.json");
  auto options = std::make_shared<FitCommand>();
  options->table.add_options(*command);
  command
      ->add_option("--model", options->model,
                   "Kind of regression: parametric (quartic roughness, slope of exponentials)")
      ->check(CLI::IsMember({"parametric"}))
      ->capture_default_str();
  command->add_option("--id", options->options.id, "Name of the converter; default: <source>_to_<target>");
  command->add_option("--seed", options->options.seed, "Of the split into training and held-out rows")
      ->capture_default_str();
  command
      ->add_option("--held-out", options->options.held_out_fraction, "Share of the rows that judges the fit")
      ->capture_default_str();
  command->add_option("-o,--output", options->folder, "Folder for the fit")->capture_default_str();
  command->add_flag("--json", options->json, "Summary as JSON on standard output");
  command->footer("Example:\n  remapc fit ward_to_as.csv -o fits");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
