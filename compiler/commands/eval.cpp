// This file is `remapc eval`, which prints the errors of a fit on a table, or its results on a grid.
#include <array>
#include <iostream>

#include "build/fit_folder.hpp"
#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "lower/interpreter.hpp"
#include "table/regression.hpp"

namespace remap {
namespace {

struct EvalOptions {
  std::string fit;
  TableInput table;
  std::filesystem::path fit_folder;
  std::size_t grid = 0;  // steps of each parameter; 0: errors on the table
  std::filesystem::path output;
  bool force = false, json = false;
};

// Returns the converted values of a grid over the domain, in the models' own parameters.
std::string grid_text(const Fit& fit, std::size_t steps) {
  const auto at = [steps](const Range& range, std::size_t step) {
    const double share = static_cast<double>(step) / static_cast<double>(steps - 1);
    return step + 1 == steps ? range.max : range.min + (range.max - range.min) * share;
  };
  const auto names = [](const std::string& prefix, const ModelSide& side) {
    return prefix + std::string(encoding_name(side.roughness)) + "," + prefix + side.specular;
  };
  std::string text = names("source_", fit.source) + "," + names("target_", fit.target) + "\n";
  for (std::size_t i = 0; i < steps; ++i)
    for (std::size_t j = 0; j < steps; ++j) {
      const double width = at(own_roughness_range(fit), i);
      const std::array<double, 1> specular = {at(specular_range(fit), j)};
      std::array<double, 1> out{};
      const double target_width = evaluate_texel(fit, width, specular, out);
      text += number_text(width) + "," + number_text(specular[0]) + "," + number_text(target_width) + "," +
              number_text(out[0]) + "\n";
    }
  return text;
}

void write_grid(const Fit& fit, const EvalOptions& options) {
  const std::string text = grid_text(fit, options.grid);
  if (options.output.empty()) {
    std::cout << text;
    return;
  }
  write_file(options.output, text);
}

// Refuses a table of other models, because its errors would say nothing about the fit.
void require_same_models(const Fit& fit, const Table& table) {
  const auto pair = [](const auto& ends) { return ends.source.model + " to " + ends.target.model; };
  if (!table.source.model.empty() && pair(table) != pair(fit))
    throw usage_error(table.name + ": is a table of " + pair(table) + ", but " + fit.id + " converts " +
                      pair(fit) + " (give a table of these models)");
}

void print_errors(const Fit& fit, const EvalOptions& options) {
  std::string bytes;
  const Table table = options.table.read(&bytes);
  require_same_models(fit, table);
  const std::vector<TableRow> usable = answer_rows(table), rows = rows_inside(usable, fit.domain);
  const std::size_t outside = usable.size() - rows.size();
  if (rows.empty())
    throw input_error(table.name + ": no usable rows in the domain of " + fit.id +
                      " (give a table with rows in this domain)");
  const Residuals residuals = residuals_of(rows, fit);
  const ErrorFigures alpha = error_figures(residuals.alpha), specular = error_figures(residuals.specular);
  const bool same_table = sha256(bytes) == fit.table.sha256;
  if (options.json) {
    const Json json = {{"fit", fit.id},
                       {"table", table.name},
                       {"fitted_from_this_table", same_table},
                       {"rows", rows.size()},
                       {"rows_outside_domain", outside},
                       {"alpha_error", figures_json(alpha)},
                       {"specular_error", figures_json(specular)}};
    std::cout << json.dump(2) << "\n";
    return;
  }
  const auto print = [](const std::string& name, const ErrorFigures& f) {
    std::cout << "  " << name << ": rms " << error_text(f.rms) << ", 99 % " << error_text(f.p99) << ", max "
              << error_text(f.max) << "\n";
  };
  std::cout << fit.id << " on " << counted(rows.size(), "row") << " of " << table.name
            << (same_table ? " (the table that it was fitted to, training rows included)" : "") << "\n";
  if (outside != 0) std::cout << "  " << counted(outside, "row") << " outside its domain skipped\n";
  print("alpha", alpha);
  print(fit.target.specular, specular);
}

void run(const EvalOptions& options) {
  if (options.table.path.empty() == (options.grid == 0))
    throw usage_error(
        options.grid == 0
            ? "eval: a table is required (write remapc eval FIT TABLE.csv, or remapc eval FIT --grid N)"
            : "--grid cannot be used with a table (remove one of the two)");
  if (options.grid == 0 && !options.output.empty())
    throw usage_error("--output cannot be used with a table (remove it, or replace the table by --grid N)");
  require_new(options.output, options.force);
  const Fit fit = find_fit(options.fit, options.fit_folder);
  if (options.grid == 0)
    print_errors(fit, options);
  else
    write_grid(fit, options);
}

}  // namespace

void add_eval_command(Command& app) {
  Command* command =
      app.add_subcommand("eval", "Print the errors of a fit on a table, or its values on a grid", kLookStage);
  EvalOptions& options = set_work<EvalOptions>(*command, run);
  command->add_option("fit", options.fit, "Fit: file, or id in the folder of fits")->required();
  options.table.add_options(*command, false);
  add_fits_option(*command, options.fit_folder, "Folder where ids are looked up");
  command->option_group("Output");
  command
      ->add_option(
          "--grid N", options.grid,
          "Print converted values as CSV instead, for N x N source values in even steps over the domain")
      ->range(std::size_t{2}, std::size_t{1024});
  command->add_option("-o,--output FILE", options.output,
                      "File for the values of --grid (default: standard output)");
  add_force_flag(*command, options.force);
  command->add_flag("--json", options.json, "Print the figures as JSON to standard output");
  command->footer(
      "Example:\n  remapc eval fits/mitsuba_ward_to_mitsuba_as.json other.csv\n"
      "  remapc eval mitsuba_ward_to_mitsuba_as --grid 33 -o ward_to_as.csv");
}

}  // namespace remap
