// This file is `remapc export`, which writes a table of any form as plain CSV. A file beside it records how
// the table was made.
#include <algorithm>

#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "table/csv.hpp"

namespace remap {
namespace {

struct ExportOptions {
  TableInput table;
  std::filesystem::path output;
  bool force = false;
};

// Adds the models of the table as comments, if its columns or options name them.
std::string text_of(Table table) {
  const auto add = [&](const std::string& key, std::string_view value) {
    if (!value.empty() && !std::ranges::count(table.comments, key, &Comments::value_type::first))
      table.comments.emplace_back(key, value);
  };
  for (const auto& [role, side] : {std::pair{"source", &table.source}, std::pair{"target", &table.target}}) {
    add(role, side->model);
    add(std::string(role) + "_roughness", encoding_name(side->roughness));
    add(std::string(role) + "_specular", side->specular);
  }
  return table_text(table);
}

std::string text_of(const MaterialTable& table) { return material_table_text(table); }

void run(const ExportOptions& options) {
  require_new_table(options.output, options.force);
  write_plain_table(options.output,
                    std::visit([](const auto& table) { return text_of(table); }, options.table.read_any()));
}

}  // namespace

void add_export_command(Command& app) {
  Command* command = app.add_subcommand(
      "export", "Write a table as plain CSV, which numpy, pandas and spreadsheets read", kMeasureStage);
  ExportOptions& options = set_work<ExportOptions>(*command, run);
  options.table.add_options(*command);
  command->option_group("Output");
  command
      ->add_option("-o,--output FILE", options.output,
                   "CSV table to write; FILE.json records how it was made")
      ->required();
  add_force_flag(*command, options.force);
  command->footer("Example:\n  remapc export fits/tables/mitsuba_ward_to_mitsuba_as.csv -o plain.csv");
}

}  // namespace remap
