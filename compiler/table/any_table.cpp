#include "table/any_table.hpp"

#include "table/csv.hpp"

namespace remapc {

AnyTable parse_any_table(std::string_view text, const std::string& name, const ColumnMap& map) {
  const Csv csv = parse_csv(text, name);
  if (!csv.comment(kSourceColumnsComment).empty()) return material_table_from_csv(csv);
  return table_from_csv(csv, map);
}

}  // namespace remapc
