// This target reads journals of output folders, for a run of all sets and for a part. It then does what a run
// does that continues in such a folder.
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <unistd.h>

#include "core/files.hpp"
#include "fuzz/fuzz.hpp"
#include "texremap/run/journal.hpp"

namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

remap::Journal opened(const fs::path& folder, const std::optional<remap::Part>& part) {
  return {folder, {"mitsuba/ward", "mitsuba/as", "1f", {{"version", "0.1.0"}}}, part};
}

// Another run has written the file in the meantime.
void require_refusal(remap::Journal& journal, const fs::path& file) {
  write(file, "other");
  if (journal.is_own(file)) return;
  bool is_refused = false;
  remap::read_or_refuse([&] {
    is_refused = true;
    journal.commit("c", "2e", {remap::FinishedFile{file, 5, "3d"}}, false, [&] { is_refused = false; });
  });
  if (!is_refused) std::abort();
}

void run_on(const fs::path& folder, const fs::path& map, const std::optional<remap::Part>& part) {
  remap::read_or_refuse([&] { opened(folder, part).require_own(); });
  remap::read_or_refuse([&] { opened(folder / "", part).claim(false); });
  remap::read_or_refuse([&] {
    remap::Journal journal = opened(folder, part);
    (void)journal.is_own(map);
    (void)journal.is_done("2e", {map});
    (void)journal.files_of("a");
    (void)remap::JournalLookup().target_of(remap::InputFile(map));
    journal.begin({map, folder / "\xff_rough.tga"});  // this name is not UTF-8
    journal.claim(true);
    journal.commit("a", "2e", {remap::FinishedFile{map, 3, "3d"}}, true, [] {});
    if (!journal.is_own(map)) std::abort();
    (void)journal.files_of("a");
    (void)journal.is_done("2e", {map});
    require_refusal(journal, folder / "c_rough.tga");
    opened(folder, part).require_own();
    journal.require_own();
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fs::path folder = "/dev/shm/remap-fuzz-journal-" + std::to_string(::getpid());
  const fs::path map = folder / "a_rough.tga", parts = folder / remap::kPartsFolder;
  const std::string_view bytes = remap::text_of(data, size);
  const auto fresh_folder = [&] {
    fs::remove_all(folder);
    fs::create_directories(parts);
    write(map, "map");
  };
  fresh_folder();
  write(folder / remap::kJournalName, bytes);
  run_on(folder, map, std::nullopt);
  fresh_folder();
  for (const std::size_t index : {1u, 3u}) {
    const fs::path journal = parts / (remap::name_of({index, 3}) + remap::kPartJournal);
    write(journal, bytes);
    // The last line about a file is used, which is the line of this run.
    fs::last_write_time(journal, fs::file_time_type::clock::now() - std::chrono::hours(1));
  }
  run_on(folder, map, remap::Part{2, 3});
  fs::remove_all(folder);
  return 0;
}
