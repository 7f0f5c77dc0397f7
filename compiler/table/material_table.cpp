#include "table/material_table.hpp"

#include "core/nearest_name.hpp"

namespace remap {
namespace {

std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  for (const CsvCell& cell : split_csv_line(text, ',')) names.emplace_back(cell.text);
  return names;
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

MaterialTable material_table_from_csv(const Csv& csv) {
  MaterialTable table;
  table.name = csv.name;
  table.remarks = csv.remarks;
  for (const auto& comment : csv.comments)
    if (comment.first != kSourceColumnsComment && comment.first != kTargetColumnsComment)
      table.comments.push_back(comment);
  for (const char* key : {kSourceColumnsComment, kTargetColumnsComment})
    if (csv.comment(key).empty())
      csv.fail(csv.header.number, 1,
               std::string("has no comment ") + key + " (it must list the names of columns)");
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

}  // namespace

MaterialTable parse_material_table(std::string_view text, const std::string& name) {
  return material_table_from_csv(parse_csv(text, name));
}

std::string material_table_text(const MaterialTable& table) {
  const std::string sources = joined(table.source_columns, ","), targets = joined(table.target_columns, ",");
  Comments comments = table.comments;
  comments.emplace_back(kSourceColumnsComment, sources);
  comments.emplace_back(kTargetColumnsComment, targets);
  CsvText csv(sources + "," + targets + ",error,status", comments);
  for (const NamedRow& row : table.rows)
    csv.add_row(row.source, row.target, row.error, status_name(row.status));
  return csv.text();
}

AnyTable parse_any_table(std::string_view text, const std::string& name, const ColumnMap& map) {
  return any_table(parse_csv(text, name), map);
}

AnyTable any_table(const Csv& csv, const ColumnMap& map) {
  if (csv.comment(kSourceColumnsComment).empty()) return table_from_csv(csv, map);
  return material_table_from_csv(csv);
}

}  // namespace remap
