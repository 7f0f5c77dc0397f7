#include "commands/table_input.hpp"

#include "system/files.hpp"

namespace remapc {

void TableInput::add_options(CLI::App& app) {
  app.add_option("table", path, "Table (CSV)")->required();
  app.add_option("--columns", columns, "Column map: sztrajman-2019 (the published table), or own=file,...");
  app.add_option("--source", source, "Source model, where the table does not name it");
  app.add_option("--target", target, "Target model, where the table does not name it");
}

Table TableInput::read(std::string* bytes) const {
  std::string content = remap::read_file(path);
  Table table = parse_table(content, path, columns.empty() ? ColumnMap{} : column_map(columns));
  if (!source.empty()) table.source.model = source;
  if (!target.empty()) table.target.model = target;
  if (bytes != nullptr) *bytes = std::move(content);
  return table;
}

}  // namespace remapc
