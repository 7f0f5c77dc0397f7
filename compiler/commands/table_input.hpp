// This file declares the options by which a command reads a table.
#pragma once

#include <string>

#include "command_line/command.hpp"
#include "table/material_table.hpp"

namespace remap {

struct TableInput {
  std::string path;
  ColumnMap columns;
  std::string source, target;  // models; if empty, the table names them

  // Adds the options. `is_required` is true if the command needs a table.
  void add_options(Command& app, bool is_required = true);

  // Reads the file once. `bytes`, if not null, receives its whole_text(). Throws kInput and kUsage like
  // parse_table. A table of named parameters is an error.
  Table read(std::string* bytes = nullptr) const;
  // Reads a table of either form.
  AnyTable read_any(std::string* bytes = nullptr) const;

 private:
  Table with_models(Table table) const;
};

Reader<ColumnMap> columns_reader();

// Adds --accept-light, which accepts light that is_wrong_light() (table/light.hpp) finds.
void add_accept_light_flag(Command& app, bool& accept_light);

}  // namespace remap
