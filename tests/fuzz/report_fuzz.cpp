// Reports of parts, as `texremap merge-reports` reads them: the first and second part of a conversion have
// the same report, so what occurs twice is met as well.
#include <fstream>
#include <unistd.h>

#include "fuzz/fuzz.hpp"
#include "texremap/part_report.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path output = "/dev/shm/remap-fuzz-report-" + std::to_string(::getpid());
  std::filesystem::create_directories(output / remap::kPartsFolder);
  for (const std::size_t index : {1u, 2u})
    std::ofstream(remap::report_of(output, {index, 2}), std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return remap::read_or_refuse([&] { remap::merge_reports(output, [](std::string_view) {}); });
}
