// A table of either form: alpha and specular (remapc sweep), or named parameters (remapc sample).
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "table/material_table.hpp"
#include "table/table.hpp"

namespace remapc {

using AnyTable = std::variant<Table, MaterialTable>;

// Parses CSV text once and reads it as the form that its comments declare: a comment source_columns makes it
// a MaterialTable. `map` applies to a Table only. Throws as parse_table and parse_material_table do.
AnyTable parse_any_table(std::string_view text, const std::string& name, const ColumnMap& map = {});

}  // namespace remapc
