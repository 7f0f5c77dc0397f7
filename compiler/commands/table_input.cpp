#include "commands/table_input.hpp"

#include <utility>

#include "command_line/command.hpp"
#include "command_line/run_app.hpp"
#include "core/files.hpp"
#include "table/csv.hpp"

namespace remap {

static void print(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) print_message("remapc", remark);
}

void TableInput::add_options(Command& app, bool is_required) {
  Option* table = app.add_option("table", path, "CSV table, of remapc sweep or of another program");
  if (is_required) table->required();
  app.option_group("Input");
  app.add_option(
      "--columns MAP", columns, columns_reader(),
      "Names of the columns in the file, as OWN=FILE,... (default: detected for the published table, "
      "sztrajman-2019)");
  app.add_option("--source,--from MODEL", source, "Source model (default: from the table)");
  app.add_option("--target,--to MODEL", target, "Target model (default: from the table)");
}

Table TableInput::read(std::string* bytes) const {
  const std::string content = read_file(path);
  const Csv csv = parse_table_file(content, path);
  Table table = with_models(table_from_csv(csv, columns));
  print(table.remarks);
  if (bytes != nullptr) *bytes = whole_text(csv, content);
  return table;
}

AnyTable TableInput::read_any(std::string* bytes) const {
  const std::string content = read_file(path);
  const Csv csv = parse_table_file(content, path);
  AnyTable table = any_table(csv, columns);
  std::visit([](const auto& any) { print(any.remarks); }, table);
  if (Table* sweep = std::get_if<Table>(&table)) *sweep = with_models(std::move(*sweep));
  if (bytes != nullptr) *bytes = whole_text(csv, content);
  return table;
}

Table TableInput::with_models(Table table) const {
  if (!source.empty()) table.source.model = source;
  if (!target.empty()) table.target.model = target;
  return table;
}

Reader<ColumnMap> columns_reader() {
  return {[](const std::string&, const std::string& word) { return column_map(word); }, {}};
}

void add_accept_light_flag(Command& app, bool& accept_light) {
  app.add_flag("--accept-light", accept_light,
               "Continue even if different light of the two renderers changes specular by more than 5 %");
}

}  // namespace remap
