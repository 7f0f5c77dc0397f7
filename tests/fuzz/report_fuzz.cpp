// Reports of parts, as `texremap merge-reports` reads them: the first and second part of a conversion have
// the same report, so what occurs twice is met as well. The third is written as a run writes it, from the
// lines of the input that are JSON, and its number of parts is another one.
#include <fstream>
#include <unistd.h>

#include "core/json_field.hpp"
#include "core/plain_text.hpp"
#include "fuzz/fuzz.hpp"
#include "texremap/report/part_report.hpp"

namespace {

void write_again(const std::filesystem::path& output, std::string_view lines) {
  remap::ConvertOptions options;
  options.output = output;
  options.part = remap::GivenPart{{3, 3}, ""};
  remap::RunLines run(options);
  remap::ConversionNote note;
  note.details = {{"version", "0.1.0"}};
  run.tell(remap::part_json(*options.part, remap::ManifestHead(), note));
  for (const std::string& line : remap::parts_between(lines, '\n'))
    remap::read_or_refuse([&] { run.tell(remap::parse_json(line, "line")); });
  run.finish();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path output = "/dev/shm/remap-fuzz-report-" + std::to_string(::getpid());
  std::filesystem::remove_all(output);
  std::filesystem::create_directories(output / remap::kPartsFolder);
  for (const std::size_t index : {1u, 2u})
    std::ofstream(remap::report_of(output, {index, 2}), std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto merge = [&] { remap::merge_reports(output, [](std::string_view) {}); };
  remap::read_or_refuse(merge);
  return remap::read_or_refuse([&] {
    write_again(output, remap::text_of(data, size));
    merge();
  });
}
