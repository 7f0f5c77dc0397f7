// Journals of output folders.
#include <cstdlib>
#include <fstream>
#include <optional>
#include <unistd.h>

#include "core/files.hpp"
#include "fuzz/fuzz.hpp"
#include "texremap/journal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path folder = "/dev/shm/remap-fuzz-journal-" + std::to_string(::getpid());
  const std::filesystem::path map = folder / "a_rough.tga";
  std::filesystem::create_directories(folder);
  std::ofstream(map, std::ios::binary) << "map";
  std::ofstream(folder / remap::kJournalName, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return remap::read_or_refuse([&] {
    remap::Journal journal(folder, {"mitsuba/ward", "mitsuba/as", "1f", {{"version", "0.1.0"}}},
                           std::nullopt);
    (void)journal.is_own(map);
    (void)journal.is_done("2e", {map});
    (void)remap::JournalLookup().target_of(remap::InputFile(map));
    // Goes on, as a run does that takes the folder.
    journal.begin({map});
    journal.claim(true);
    journal.commit("a", "2e", {remap::FinishedFile{map, 3, "3d"}}, true, [] {});
    if (!journal.is_own(map)) std::abort();
    (void)journal.files_of("a");
    (void)journal.is_done("2e", {map});
    remap::Journal(folder, {"mitsuba/ward", "mitsuba/as", "1f", {{"version", "0.1.0"}}}, std::nullopt)
        .require_own();
    journal.require_own();
  });
}
