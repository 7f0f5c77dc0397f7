// `remapc eval` prints how well a fit follows a table.
#include <iostream>

#include <nlohmann/json.hpp>

#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/table_input.hpp"
#include "fit/fit_table.hpp"
#include "fit/rows/split.hpp"
#include "manifest/fit_folder.hpp"
#include "table/row_regime.hpp"
#include "text/errors.hpp"

namespace remapc {
namespace {

struct EvalOptions {
  std::string fit;
  TableInput table;
  std::filesystem::path fit_folder = "fits";
  bool json = false;
};

void run(const EvalOptions& options) {
  const remap::Fit fit = find_fit(options.fit, options.fit_folder);
  std::string bytes;
  const Table table = options.table.read(&bytes);
  const std::vector<TableRow> usable = answer_rows(table), rows = rows_inside(usable, fit.domain);
  const std::size_t outside = usable.size() - rows.size();
  if (rows.empty()) throw input_error(table.name + ": no usable rows in the domain of " + fit.id);
  const RowErrors errors = row_errors(fit, rows);
  const bool same_table = sha256(bytes) == fit.table.sha256;
  if (options.json) {
    const nlohmann::ordered_json json = {{"fit", fit.id},
                                         {"table", table.name},
                                         {"fitted_from_this_table", same_table},
                                         {"rows", rows.size()},
                                         {"rows_outside_domain", outside},
                                         {"alpha_error", figures_json(errors.alpha)},
                                         {"specular_error", figures_json(errors.specular)}};
    std::cout << json.dump(2) << "\n";
    return;
  }
  const auto print = [](const std::string& name, const remap::ErrorFigures& f) {
    std::cout << "  " << name << ": rms " << error_text(f.rms) << ", 99 % " << error_text(f.p99) << ", max "
              << error_text(f.max) << "\n";
  };
  std::cout << fit.id << " on " << rows.size() << " rows of " << table.name
            << (same_table ? " (the table that it was fitted to, training rows included)" : "") << "\n";
  if (outside != 0) std::cout << "  " << outside << " rows outside its domain skipped\n";
  print("alpha", errors.alpha);
  print(fit.target.specular, errors.specular);
}

}  // namespace

void add_eval_command(remap::Command& app) {
  remap::Command* command =
      app.add_subcommand("eval", "Print the errors of a fit on the usable rows of a table", kLookStage);
  EvalOptions& options = set_work<EvalOptions>(*command, run);
  command->add_option("fit", options.fit, "Fit: file, or id in the folder of fits")->required();
  options.table.add_options(*command);
  command->add_option("--fits FOLDER", options.fit_folder, "Folder where ids are looked up");
  command->option_group("Output");
  command->add_flag("--json", options.json, "Print the figures as JSON to standard output");
  command->footer("Example:\n  remapc eval fits/mitsuba_ward_to_mitsuba_as.json other.csv");
}

}  // namespace remapc
