// Tables as CSV, of both forms, and their checks.
#include "fuzz/fuzz.hpp"
#include "table/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return remap::read_or_refuse([&] {
    const remap::AnyTable table = remap::parse_any_table(remap::text_of(data, size), "table.csv", {});
    std::visit([](const auto& any) { remap::check_table(any); }, table);
  });
}
