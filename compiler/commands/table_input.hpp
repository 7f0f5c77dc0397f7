// The options by which a command takes a table.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "table/table.hpp"

namespace remapc {

struct TableInput {
  std::string path;
  std::string columns;         // preset or own=file pairs; empty: own names
  std::string source, target;  // models, where the table does not name them

  void add_options(CLI::App& app);
  // Reads the file once; `bytes` takes its content where given.
  Table read(std::string* bytes = nullptr) const;
};

}  // namespace remapc
