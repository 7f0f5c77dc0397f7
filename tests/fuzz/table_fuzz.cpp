// This target reads both forms of tables as CSV, and checks them. It also reads the FILE.json of a table, and
// texts of --columns. A table that is read is written as commands do, and read again.
#include <cstdlib>
#include <unistd.h>

#include "core/files.hpp"
#include "core/input_file.hpp"
#include "fuzz/fuzz.hpp"
#include "table/check.hpp"

namespace {

constexpr std::string_view kTable = "alpha1,specular1,alpha2,specular2\n.1,.5,.2,.4\n.3,.5,.4,.4\n";
constexpr std::size_t kLongestArgument = 200;

std::filesystem::path folder() {
  static const std::filesystem::path path = "/dev/shm/remap-fuzz-table-" + std::to_string(::getpid());
  std::filesystem::create_directories(path);
  return path;
}

remap::AnyTable read_any(const std::filesystem::path& file) {
  const std::string bytes = remap::read_file(file);
  return remap::any_table(remap::parse_table_file(bytes, file), {});
}

std::string text_of_any(const remap::AnyTable& table) {
  if (const auto* written = std::get_if<remap::Table>(&table)) return remap::table_text(*written);
  return remap::material_table_text(std::get<remap::MaterialTable>(table));
}

void read_metadata(std::string_view json) {
  const std::filesystem::path file = folder() / "table.csv";
  remap::write_file(file, kTable, remap::Flush::kNo);
  remap::write_file(file.string() + ".json", json, remap::Flush::kNo);
  (void)remap::read_table(file);
}

void write_again(const remap::AnyTable& table) {
  const std::filesystem::path file = folder() / "again.csv";
  remap::write_plain_table(file, text_of_any(table));
  const remap::AnyTable again = read_any(file);
  std::filesystem::remove(file.string() + ".json");
  if (table.index() != again.index()) std::abort();
}

void use(const remap::Table& table) {
  for (const remap::TableRow& row : remap::rows_inside(remap::answer_rows(table), {{0.1, 0.5}, {0.0, 1.0}}))
    if (!remap::has_answer(row)) std::abort();
  (void)remap::table_record("table.csv", "bytes", table.comments);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = remap::text_of(data, size);
  if (text.starts_with("{")) remap::read_or_refuse([&] { read_metadata(text); });
  if (size <= kLongestArgument && remap::is_plain_text(text))  // an argument, which is printed as plain text
    remap::read_or_refuse(
        [&] { (void)remap::parse_table(kTable, "table.csv", remap::column_map(std::string(text))); });
  return remap::read_or_refuse([&] {
    const remap::AnyTable table = remap::parse_any_table(text, "table.csv", {});
    std::visit([](const auto& any) { remap::check_table(any); }, table);
    if (const auto* sweep = std::get_if<remap::Table>(&table)) use(*sweep);
    write_again(table);
  });
}
