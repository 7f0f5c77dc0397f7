#include "build/reach_record.hpp"

#include <array>

#include "core/files.hpp"
#include "core/input_file.hpp"
#include "core/number_text.hpp"
#include "table/csv.hpp"
#include "table/table.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr std::array kReachColumns = {"converter",      "fit",   "materials", "mean_excess",
                                      "largest_excess", "alpha", "specular"};

}  // namespace

ReachRecords read_reach(const fs::path& folder) {
  const fs::path path = folder / kReachName;
  ReachRecords records;
  if (!fs::exists(path)) return records;
  const std::string text = read_file(path);
  const Csv csv = parse_csv(text, path.string());
  for (std::size_t c = 0; c < kReachColumns.size(); ++c)
    if (c >= csv.header.cells.size() || csv.header.cells[c].text != kReachColumns[c])
      csv.fail(csv.header.number, 1, std::string("column ") + kReachColumns[c] + " is missing");
  for (const CsvLine& line : csv.lines) {
    const auto number = [&](std::size_t c) { return csv.number(line, line.cells[c], kReachColumns[c]); };
    records[std::string(line.cells[0].text)] = {std::string(line.cells[1].text),
                                                static_cast<std::size_t>(number(2)),
                                                number(3),
                                                number(4),
                                                number(5),
                                                number(6)};
  }
  return records;
}

ReachRecords current_reach(const fs::path& folder) {
  ReachRecords records = read_reach(folder);
  std::erase_if(records, [&](const auto& entry) {
    return file_sha256(folder / (entry.first + ".json")) != entry.second.fit;
  });
  return records;
}

void write_reach(const fs::path& folder, const ReachRecords& records) {
  std::string text;
  for (const char* column : kReachColumns) text += (text.empty() ? "" : ",") + std::string(column);
  text += "\n";
  for (const auto& [id, record] : records) {
    text += id + "," + record.fit + "," + std::to_string(record.materials);
    for (const double value : {record.mean_excess, record.largest_excess, record.alpha, record.specular})
      text += "," + number_text(rounded(value, 3));
    text += "\n";
  }
  write_file(folder / kReachName, text);
}

}  // namespace remap
