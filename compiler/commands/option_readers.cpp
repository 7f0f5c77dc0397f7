#include "commands/option_readers.hpp"

#include <sstream>
#include <utility>

#include "build/fit_folder.hpp"
#include "command_line/command.hpp"
#include "command_line/run_app.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "table/csv.hpp"

namespace remap {

void add_fits_option(Command& app, std::filesystem::path& folder, const std::string& text) {
  folder = default_fit_folder();
  app.add_option("--fits FOLDER", folder, text)->default_text("fits, or the installed ones");
}

void add_force_flag(Command& app, bool& force) {
  app.add_flag("--force", force, "Overwrite files that exist");
}

Reader<double> light_angle() {
  return {[](const std::string& option, const std::string& word) {
            const auto angle = word == "headlight" ? 0.0 : parse_number(word);
            if (!angle || !(*angle > -180.0 && *angle <= 180.0))
              throw usage_error(option + ": invalid value '" + word +
                                "' (choose headlight, or degrees from -180 to 180)");
            return *angle;
          },
          {}};
}

Reader<Range> number_range() {
  return {[](const std::string& option, const std::string& word) {
            const std::size_t comma = word.find(',');
            const auto min = parse_number(word.substr(0, comma));
            const auto max = comma == std::string::npos ? min : parse_number(word.substr(comma + 1));
            if (comma == std::string::npos || !min || !max || !(*min <= *max))
              throw usage_error(option + ": not a range (write MIN,MAX with MIN not above MAX)");
            return Range{*min, *max};
          },
          {}};
}

ParameterSetting::ParameterSetting(const std::string& option, const std::string& word)
    : context(option + " " + word), name(word.substr(0, word.find('='))) {
  if (name == word) fail("'=' missing (write NAME=VALUE or NAME=R,G,B)");
  std::istringstream items(word.substr(name.size() + 1));
  for (std::string item; std::getline(items, item, ',');) {
    const auto value = parse_number(item);
    if (!value) fail("'" + item + "' is not a number (write NAME=VALUE or NAME=R,G,B)");
    values.push_back(*value);
  }
}

void ParameterSetting::fail(const std::string& reason) const { throw usage_error(context + ": " + reason); }

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
