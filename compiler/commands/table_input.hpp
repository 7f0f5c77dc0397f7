// The options by which a command takes a table.
#pragma once

#include <string>

#include "command_line/command.hpp"
#include "table/material_table.hpp"

namespace remap {

struct TableInput {
  std::string path;
  ColumnMap columns;
  std::string source, target;  // models; empty: as the table names them

  // `is_required`: whether the command needs a table.
  void add_options(Command& app, bool is_required = true);

  // Reads the file once. `bytes`, if not null, receives its whole_text(). Throws kInput and kUsage as
  // parse_table does; a table of named parameters is an error.
  Table read(std::string* bytes = nullptr) const;
  // The same for a table of either form.
  AnyTable read_any(std::string* bytes = nullptr) const;

 private:
  Table with_models(Table table) const;
};

// Reads --columns.
Reader<ColumnMap> columns_reader();

// Adds --accept-light, for what light_remark() (table/light.hpp) calls an error.
void add_accept_light_flag(Command& app, bool& accept_light);

}  // namespace remap
