// This file is `remapc check`, which reports what is wrong with a table.
#include "table/check.hpp"

#include <algorithm>
#include <iostream>

#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "core/errors.hpp"
#include "core/json.hpp"

namespace remap {
namespace {

struct CheckOptions {
  TableInput table;
  bool json = false, accept_light = false;
};

void print_json(const std::string& name, std::size_t rows, const std::vector<Finding>& findings) {
  Json json = {{"table", name}, {"rows", rows}, {"findings", Json::list()}};
  for (const Finding& finding : findings)
    json["findings"].push_back({{"severity", severity_name(finding.severity)},
                                {"kind", finding.kind},
                                {"line", finding.line},
                                {"message", finding.message}});
  std::cout << json.dump(2) << "\n";
}

// Checks a table of either form.
template <typename AnyForm>
void check(const AnyForm& table, const CheckOptions& options) {
  const std::size_t rows = table.rows.size();
  const std::vector<Finding> findings = check_table(table, options.accept_light);
  if (options.json)
    print_json(table.name, rows, findings);
  else
    for (const Finding& finding : findings) std::cout << finding_text(table.name, finding) << "\n";
  const auto errors = std::ranges::count(findings, Severity::kError, &Finding::severity);
  if (errors != 0)
    throw input_error(table.name + ": " + std::to_string(errors) +
                      (errors == 1 ? " error prevents" : " errors prevent") + " a fit");
  if (!options.json)
    std::cout << table.name << ": " << rows << " rows, can be fitted"
              << (findings.empty() ? ""
                                   : " (" + std::to_string(findings.size()) +
                                         (findings.size() == 1 ? " remark)" : " remarks)"))
              << "\n";
}

void run(const CheckOptions& options) {
  std::visit([&](const auto& table) { check(table, options); }, options.table.read_any());
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
