#include "table/named_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "error.hpp"
#include "number_text.hpp"
#include "table/csv.hpp"

namespace remapc {
namespace {

using remap::number_text;

// Random samples have to be some in each direction before anything can be learned from them.
constexpr std::size_t kFewestRowsAColumn = 10;

std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  for (const CsvCell& cell : split_csv_line(text, ',')) names.emplace_back(cell.text);
  return names;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

std::size_t place_of(const Csv& csv, const std::string& column) {
  for (std::size_t i = 0; i < csv.header.cells.size(); ++i)
    if (csv.header.cells[i].text == column) return i;
  csv.fail(csv.header.number, 1, "has no column " + column + ", which the comments name");
}

std::vector<std::size_t> places_of(const Csv& csv, const std::vector<std::string>& columns) {
  std::vector<std::size_t> places;
  for (const std::string& column : columns) places.push_back(place_of(csv, column));
  return places;
}

class Linter {
 public:
  explicit Linter(const NamedTable& table) : table_(table) {}

  std::vector<Finding> run() {
    check_values();
    check_row_count();
    check_columns();
    check_repeats();
    std::stable_sort(findings_.begin(), findings_.end(), [](const Finding& a, const Finding& b) {
      return a.severity != b.severity ? a.severity > b.severity : a.line < b.line;
    });
    return std::move(findings_);
  }

 private:
  void check_values() {
    const auto check = [&](const NamedRow& row, const std::vector<std::string>& columns,
                           const std::vector<double>& values) {
      for (std::size_t i = 0; i < columns.size(); ++i)
        if (!std::isfinite(values[i]))
          findings_.push_back({Severity::kError, "range", row.line,
                               columns[i] + " is " + number_text(values[i]) + "; expected a finite number"});
    };
    for (const NamedRow& row : table_.rows) {
      check(row, table_.source_columns, row.source);
      check(row, table_.target_columns, row.target);
    }
  }

  void check_row_count() {
    const auto usable =
        static_cast<std::size_t>(std::count_if(table_.rows.begin(), table_.rows.end(),
                                               [](const NamedRow& r) { return r.status == RowStatus::kOk; }));
    const std::size_t fewest = kFewestRowsAColumn * table_.source_columns.size();
    if (usable < fewest)
      findings_.push_back({Severity::kError, "rows", 0,
                           "has " + std::to_string(usable) + " usable rows for " +
                               std::to_string(table_.source_columns.size()) +
                               " source columns; expected at least " + std::to_string(fewest)});
    if (usable != table_.rows.size())
      findings_.push_back({Severity::kNote, "saturation", 0,
                           std::to_string(table_.rows.size() - usable) + " of " +
                               std::to_string(table_.rows.size()) + " rows are not ok"});
  }

  void check_columns() {
    for (std::size_t i = 0; i < table_.source_columns.size(); ++i) {
      const double first = table_.rows.front().source[i];
      if (std::all_of(table_.rows.begin(), table_.rows.end(),
                      [&](const NamedRow& row) { return row.source[i] == first; }))
        findings_.push_back({Severity::kWarning, "gap", 0,
                             table_.source_columns[i] + " is " + number_text(first) +
                                 " in every row; nothing is said of other values"});
    }
  }

  void check_repeats() {
    std::map<std::vector<double>, const NamedRow*> known;
    for (const NamedRow& row : table_.rows) {
      const auto [found, is_new] = known.emplace(row.source, &row);
      if (is_new) continue;
      const bool same = found->second->target == row.target;
      findings_.push_back({same ? Severity::kWarning : Severity::kError, same ? "duplicate" : "contradiction",
                           row.line,
                           "the sample stands in line " + std::to_string(found->second->line) + " too" +
                               (same ? "; it counts twice in a fit" : ", with other target values")});
    }
  }

  const NamedTable& table_;
  std::vector<Finding> findings_;
};

}  // namespace

bool is_named_table(std::string_view text, const std::string& name) {
  return !parse_csv(text, name).comment(kSourceColumnsComment).empty();
}

NamedTable parse_named_table(std::string_view text, const std::string& name) {
  const Csv csv = parse_csv(text, name);
  NamedTable table;
  table.name = name;
  for (const auto& comment : csv.comments)
    if (comment.first != kSourceColumnsComment && comment.first != kTargetColumnsComment)
      table.comments.push_back(comment);
  for (const char* key : {kSourceColumnsComment, kTargetColumnsComment})
    if (csv.comment(key).empty())
      csv.fail(csv.header.number, 1,
               std::string("has no comment ") + key + "; expected the names of columns");
  table.source_columns = split_names(csv.comment(kSourceColumnsComment));
  table.target_columns = split_names(csv.comment(kTargetColumnsComment));
  const auto sources = places_of(csv, table.source_columns), targets = places_of(csv, table.target_columns);
  const std::size_t error = place_of(csv, "error"), status = place_of(csv, "status");
  for (const CsvLine& line : csv.lines) {
    NamedRow row;
    const auto number = [&](std::size_t place) {
      return csv.number(line, line.cells[place], std::string(csv.header.cells[place].text));
    };
    for (const std::size_t place : sources) row.source.push_back(number(place));
    for (const std::size_t place : targets) row.target.push_back(number(place));
    row.error = number(error);
    row.status = read_status(csv, line, line.cells[status]);
    row.line = line.number;
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string named_table_text(const NamedTable& table) {
  const std::string sources = joined(table.source_columns), targets = joined(table.target_columns);
  std::string text;
  for (const auto& [key, value] : table.comments) text += "# " + key + ": " + value + "\n";
  text += std::string("# ") + kSourceColumnsComment + ": " + sources + "\n";
  text += std::string("# ") + kTargetColumnsComment + ": " + targets + "\n";
  text += sources + "," + targets + ",error,status\n";
  for (const NamedRow& row : table.rows) {
    for (const std::vector<double>* values : {&row.source, &row.target})
      for (const double value : *values) text += number_text(value) + ",";
    text += number_text(row.error) + "," + std::string(status_name(row.status)) + "\n";
  }
  return text;
}

std::vector<Finding> check_named_table(const NamedTable& table) { return Linter(table).run(); }

}  // namespace remapc
