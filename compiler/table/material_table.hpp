// The table of a sweep over more parameters than width and specular. It has a column for each parameter and
// channel, named as the models name them (Sztrajman et al. 2019, section 5.2: random samples; section 8).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "table/table.hpp"

namespace remapc {

struct NamedRow {
  std::vector<double> source, target;  // one value for each column, in the parameters' own units
  double error = 0.0;                  // image error of the match over all channels, relative RMS
  RowStatus status = RowStatus::kOk;
  std::size_t line = 0;  // in the file it was read from, 1-based; 0 for a new row
};

struct MaterialTable {
  std::string name;                                           // file name, for messages
  std::vector<std::pair<std::string, std::string>> comments;  // without the two that list columns
  std::vector<std::string> source_columns, target_columns;    // base_color_r1, ..., roughness2
  std::vector<NamedRow> rows;
};

// Parses what material_table_text writes and ignores other columns. Throws kInput with `name:line:column:`.
MaterialTable parse_material_table(std::string_view text, const std::string& name);

// The same from CSV text that parse_csv has split.
MaterialTable material_table_from_csv(const Csv& csv);

std::string material_table_text(const MaterialTable& table);

}  // namespace remapc
