// This file declares the options by which a command reads a table.
#pragma once

#include <string>

#include "command_line/command.hpp"
#include "table/table.hpp"

namespace remap {

struct TableInput {
  std::string path;
  ColumnMap columns;
  std::string source, target;  // models; if empty, the table names them

  // Adds the options. `is_required` is true if the command needs a table.
  void add_options(Command& app, bool is_required = true);

  // Reads the file once. If `bytes` is not null, it receives whole_text() of the table. Throws kInput and
  // kUsage like parse_table(). For a table of named parameters, throws an error.
  Table read(std::string* bytes = nullptr) const;
  // Reads a table of either form.
  AnyTable read_any(std::string* bytes = nullptr) const;

 private:
  Table with_models(Table table) const;
};

Reader<ColumnMap> columns_reader();

// Adds --accept-light. With it, a difference of light that light_remark() (table/light.hpp) would report as
// an error is accepted.
void add_accept_light_flag(Command& app, bool& accept_light);

}  // namespace remap
