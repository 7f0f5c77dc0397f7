// `remapc check`: lints a table.
#include "table/check.hpp"

#include <algorithm>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "commands/table_input.hpp"
#include "error.hpp"

namespace remapc {
namespace {

struct CheckOptions {
  TableInput table;
  bool json = false;
};

void print_json(const Table& table, const std::vector<Finding>& findings) {
  nlohmann::ordered_json json = {
      {"table", table.name}, {"rows", table.rows.size()}, {"findings", nlohmann::json::array()}};
  for (const Finding& finding : findings)
    json["findings"].push_back({{"severity", severity_name(finding.severity)},
                                {"kind", finding.kind},
                                {"line", finding.line},
                                {"message", finding.message}});
  std::cout << json.dump(2) << "\n";
}

void run(const CheckOptions& options) {
  const Table table = options.table.read();
  const std::vector<Finding> findings = check_table(table);
  if (options.json)
    print_json(table, findings);
  else
    for (const Finding& finding : findings) std::cout << finding_text(table, finding) << "\n";
  const auto errors = std::count_if(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.severity == Severity::kError;
  });
  if (errors != 0)
    throw remap::Error(
        remap::ErrorKind::kInput,
        table.name + ": cannot be fitted: " + std::to_string(errors) + (errors == 1 ? " error" : " errors"));
  if (!options.json)
    std::cout << table.name << ": " << table.rows.size() << " rows, can be fitted"
              << (findings.empty() ? ""
                                   : " (" + std::to_string(findings.size()) +
                                         (findings.size() == 1 ? " remark)" : " remarks)"))
              << "\n";
}

}  // namespace

void add_check_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("check", "Look for what is wrong with a table before it is fitted");
  auto options = std::make_shared<CheckOptions>();
  options->table.add_options(*command);
  command->add_flag("--json", options->json, "Findings as JSON on standard output");
  command->footer("Exit code 1 where the table cannot be fitted.\nExample:\n  remapc check ward_to_as.csv");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
