// This file reads options: lights, ranges, numbers by the names of parameters, and tables.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "remap/model.hpp"
#include "table/table.hpp"

namespace remap {

// Adds --fits, whose default is default_fit_folder().
void add_fits_option(Command& app, std::filesystem::path& folder, const std::string& text);

// Adds --force. Without it, require_new() (core/files.hpp) refuses to replace a result.
void add_force_flag(Command& app, bool& force);

// Reads the angle of a light: `headlight`, or degrees from the camera.
Reader<double> light_angle();

// Reads `MIN,MAX`.
Reader<Range> number_range();

// A ParameterSetting is `NAME=VALUE` or `NAME=VALUE,...`. Throws kUsage, beginning with option and word.
struct ParameterSetting {
  ParameterSetting(const std::string& option, const std::string& word);
  [[noreturn]] void fail(const std::string& reason) const;  // throws kUsage

  std::string context;  // option and word, with which messages begin
  std::string name;
  std::vector<double> values;
};

// Adds an option that is given once for each parameter. `value_of` makes the value for its name.
template <typename Value>
void add_settings(Command& app, const std::string& names, std::map<std::string, Value>& values,
                  const std::function<Value(const ParameterSetting&)>& value_of,
                  const std::string& description) {
  using Values = std::map<std::string, Value>;
  constexpr int kMost = 1 << 16;
  const auto read = [&values, value_of](const std::string& option, const std::string& word) {
    const ParameterSetting setting(option, word);
    Values all = values;
    all[setting.name] = value_of(setting);
    return all;
  };
  app.add_option(names, values, Reader<Values>{read, {}}, description)
      ->expected(1, kMost)
      ->allow_extra_args(false);
}

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

// Adds --accept-light. With it, a difference of light that light_remark() (table/table.hpp) would report as
// an error is accepted.
void add_accept_light_flag(Command& app, bool& accept_light);

}  // namespace remap
