// Tables as CSV, of both forms, and their checks.
#include "fuzz/fuzz.hpp"
#include "table/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return remap::read_or_refuse([&] {
    const auto text = remap::text_of(data, size);
    if (text.starts_with("{")) remap::parse_metadata(text, "table.csv.json");
    const remap::AnyTable table = remap::parse_any_table(text, "table.csv", {});
    std::visit([](const auto& any) { remap::check_table(any); }, table);
    if (const auto* written = std::get_if<remap::Table>(&table))
      remap::parse_table(remap::table_text(*written), "again.csv");
    else
      remap::parse_material_table(remap::material_table_text(std::get<remap::MaterialTable>(table)),
                                  "again.csv");
  });
}
