// `remapc import` makes a fit from a regression that was trained elsewhere.
#include <iostream>

#include <nlohmann/json.hpp>

#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/table_input.hpp"
#include "fit/fit_table.hpp"
#include "fit/svr/svr_import.hpp"
#include "remap/fit_file.hpp"
#include "system/files.hpp"
#include "text/errors.hpp"

namespace remapc {
namespace {

struct ImportCommand {
  std::string description;
  TableInput table;  // without a path: errors are unknown
  std::filesystem::path folder = "fits";
  bool json = false;
};

// Measures the errors of `fit` on all usable rows of the table: which of them trained it is unknown.
void judge(remap::Fit& fit, const ImportCommand& command) {
  std::string bytes;
  const Table table = command.table.read(&bytes);
  const std::vector<TableRow> rows = rows_inside(usable_rows(table), fit.domain);
  if (rows.empty()) throw input_error(table.name + ": no usable rows in the domain of " + fit.id);
  const RowErrors errors = row_errors(fit, rows);
  fit.alpha_error = errors.alpha;
  fit.specular_error = errors.specular;
  fit.split.held_out_fraction = 1.0;
  fit.split.held_out_rows = static_cast<std::int64_t>(rows.size());
  fit.table = table_record(table.name, bytes, table.comments);
  fit.method["imported"] =
      "libsvm model files; errors are those on the usable rows of the table, which may have trained them";
}

void run(const ImportCommand& command) {
  remap::Fit fit = import_svr(command.description);
  const bool is_judged = !command.table.path.empty();
  if (is_judged) judge(fit, command);
  const std::filesystem::path path = command.folder / (fit.id + ".json");
  remap::write_file(path, remap::fit_to_json(fit));
  const auto& svr = std::get<remap::Svr>(fit.mapping);
  if (command.json) {
    const auto figures = [is_judged](const remap::ErrorFigures& known) {
      return is_judged ? figures_json(known) : nullptr;
    };
    const nlohmann::ordered_json json = {{"fit", path.string()},
                                         {"id", fit.id},
                                         {"alpha_vectors", svr.alpha.count()},
                                         {"specular_vectors", svr.specular.count()},
                                         {"rows", fit.split.held_out_rows},
                                         {"alpha_error", figures(fit.alpha_error)},
                                         {"specular_error", figures(fit.specular_error)}};
    std::cout << json.dump(2) << "\n";
    return;
  }
  std::cerr << path.string() << ": svr, " << svr.alpha.count() << " vectors for alpha, "
            << svr.specular.count() << " for " << fit.target.specular << "; "
            << errors_text(fit, "of the table") << (is_judged ? "" : " (--table measures them)") << "\n";
}

}  // namespace

void add_import_command(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "import", "Make a fit from libsvm model files (RBF regressions trained elsewhere)", kFitStage);
  ImportCommand& options = set_work<ImportCommand>(*command, run);
  command->add_option("description", options.description, "JSON file that describes the models, see below")
      ->required();
  command->option_group("Input");
  command->add_option("--table FILE", options.table.path,
                      "Table (CSV) to measure errors on (default: errors unknown)");
  command->add_option("--columns MAP", options.table.columns,
                      "Names of columns in the table: sztrajman-2019 (the published table), or OWN=FILE,...");
  command->option_group("Output");
  command->add_option("-o,--output FOLDER", options.folder, "Folder for the fit");
  command->add_flag("--json", options.json, "Print a summary as JSON to standard output");
  command->footer(
      "The description holds \"source\", \"target\" and \"domain\" as a fit file does, and for each of "
      "\"alpha\" and \"specular\":\n"
      "  {\"model_file\": \"alpha.model\",\n"
      "   \"inputs\": [{\"name\": \"alpha\", \"offset\": 0.02, \"scale\": 1.02}],\n"
      "   \"output\": {\"offset\": 0, \"scale\": 1}}\n"
      "where normalised = (value - offset) * scale. From scikit-learn's MinMaxScaler: scale = scale_, offset "
      "= "
      "-min_ / scale_; from StandardScaler: scale = 1 / scale_, offset = mean_. Alpha is the microfacet "
      "width, whatever the models' own parameters are.\n\n"
      "Example:\n  remapc import my_svr.json --table ward_to_as.csv -o fits");
}

}  // namespace remapc
