// This target reads reports of parts, as `texremap merge-reports` does. The first and the second part of a
// conversion have the same report, so everything occurs twice. A run writes the third report, from the lines
// of the input that are JSON. This report states another number of parts.
#include <fstream>
#include <unistd.h>

#include "core/json_field.hpp"
#include "core/plain_text.hpp"
#include "fuzz/fuzz.hpp"
#include "texremap/report/part_report.hpp"

namespace {

void write_again(const std::filesystem::path& output, std::string_view lines) {
  const remap::Part part{3, 3};
  remap::ConversionNote note;
  note.details = {{"version", "0.1.0"}};
  std::string report = remap::part_json(part, remap::ManifestHead(), note).dump() + "\n";
  for (const std::string& line : remap::parts_between(lines, '\n'))
    remap::read_or_refuse([&] { report += remap::parse_json(line, "line").dump() + "\n"; });
  remap::write_part_report(output, part, report);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path output = "/dev/shm/remap-fuzz-report-" + std::to_string(::getpid());
  std::filesystem::remove_all(output);
  std::filesystem::create_directories(output / remap::kPartsFolder);
  for (const std::size_t index : {1u, 2u})
    std::ofstream(output / remap::kPartsFolder / (remap::name_of(remap::Part{index, 2}) + remap::kPartReport),
                  std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto merge = [&] { remap::merge_reports(output, [](std::string_view) {}); };
  remap::read_or_refuse(merge);
  return remap::read_or_refuse([&] {
    write_again(output, remap::text_of(data, size));
    merge();
  });
}
