// This file holds the table of a sweep over more parameters than width and specular. It has a column for each
// parameter and channel, named as the models name them (Sztrajman et al. 2019, section 5.2: random samples;
// section 8).
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "table/table.hpp"

namespace remap {

struct NamedRow {
  std::vector<double> source, target;  // one value for each column, in the parameters' own units
  double error = 0.0;                  // image error of the match over all channels, relative RMS
  RowStatus status = RowStatus::kOk;
  std::size_t line = 0;  // in the file it was read from, 1-based; 0 for a new row
};

struct MaterialTable {
  std::string name;                                         // file name, for messages
  Comments comments;                                        // without the two comments that list columns
  std::vector<std::string> source_columns, target_columns;  // base_color_r1, ..., roughness2
  std::vector<NamedRow> rows;
  std::vector<std::string> remarks = {};  // what the parser assumed, for the user
};

// Parses what material_table_text writes and ignores other columns. Throws kInput with `name:line:column:`.
MaterialTable parse_material_table(std::string_view text, const std::string& name);

std::string material_table_text(const MaterialTable& table);

// An AnyTable is a table of alpha and specular (remapc sweep), or of named parameters (remapc sample).
using AnyTable = std::variant<Table, MaterialTable>;

// Makes a table from CSV text in the form that its comments declare. With a comment source_columns, it is a
// MaterialTable. `map` applies only to a Table. Throws like parse_table() and parse_material_table().
AnyTable any_table(const Csv& csv, const ColumnMap& map);
// Parses text and then calls any_table().
AnyTable parse_any_table(std::string_view text, const std::string& name, const ColumnMap& map = {});

}  // namespace remap
