// This file is `remapc check`, which reports what is wrong with a table.
#include "table/check.hpp"

#include <algorithm>
#include <iostream>

#include "commands/commands.hpp"
#include "commands/table_input.hpp"
#include "core/errors.hpp"
#include "core/json.hpp"

namespace remap {
namespace {

struct CheckOptions {
  TableInput table;
  bool json = false, accept_light = false;
};

// A Checked holds what is wrong with a table of either form.
struct Checked {
  std::string name;
  std::size_t rows = 0;
  std::vector<Finding> findings;
};

void print_json(const Checked& checked) {
  Json json = {{"table", checked.name}, {"rows", checked.rows}, {"findings", Json::list()}};
  for (const Finding& finding : checked.findings)
    json["findings"].push_back({{"severity", severity_name(finding.severity)},
                                {"kind", finding.kind},
                                {"line", finding.line},
                                {"message", finding.message}});
  std::cout << json.dump(2) << "\n";
}

void run(const CheckOptions& options) {
  const Checked checked = std::visit(
      [&](const auto& table) {
        return Checked{table.name, table.rows.size(), check_table(table, options.accept_light)};
      },
      options.table.read_any());
  if (options.json)
    print_json(checked);
  else
    for (const Finding& finding : checked.findings) std::cout << finding_text(checked.name, finding) << "\n";
  const auto errors =
      std::count_if(checked.findings.begin(), checked.findings.end(),
                    [](const Finding& finding) { return finding.severity == Severity::kError; });
  if (errors != 0)
    throw input_error(checked.name + ": " + std::to_string(errors) +
                      (errors == 1 ? " error prevents" : " errors prevent") + " a fit");
  if (!options.json)
    std::cout << checked.name << ": " << checked.rows << " rows, can be fitted"
              << (checked.findings.empty() ? ""
                                           : " (" + std::to_string(checked.findings.size()) +
                                                 (checked.findings.size() == 1 ? " remark)" : " remarks)"))
              << "\n";
}

}  // namespace

void add_check_command(Command& app) {
  Command* command = app.add_subcommand("check", "Find errors in a table before it is fitted", kMeasureStage);
  CheckOptions& options = set_work<CheckOptions>(*command, run);
  options.table.add_options(*command);
  add_accept_light_flag(*command, options.accept_light);
  command->option_group("Output");
  command->add_flag("--json", options.json, "Print the findings as JSON to standard output");
  command->footer(
      "The exit code is 1 if the table cannot be fitted.\n\nExample:\n  remapc check ward_to_as.csv");
}

}  // namespace remap
