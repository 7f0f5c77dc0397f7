// This file handles the journal of an output folder, `.texremap.jsonl`. It records the conversion that owns
// the folder, and which results came from which inputs, in any format. It has lines of JSON that are only
// ever appended:
//
//   {"conversion": {"hash": "...", "source": "mitsuba/ward", "target": "mitsuba/as", ...}}
//   {"begun": ["a_rough.tga", ...], "conversion": "HASH"}
//   {"set": "a", "inputs": "HASH", "conversion": "HASH", "source": ..., "target": ...,
//    "files": [{"name": "a_rough.tga", "bytes": 1234, "hash": "..."}, ...]}
//
// Only the last line with `conversion` is valid. `begun` is written before the first file of a set, and `set`
// after the last.
//
// Names are relative to the folder. A line that cannot be read, such as the last one of a killed run, is
// ignored. A run that converts a part of a manifest writes a separate journal, `.texremap-parts/NAME.journal`
// (part.hpp), because processes of several machines cannot append to one file of a shared file system. If
// such a run finds a file that its own journal lacks, it looks the file up in all journals.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/input_file.hpp"
#include "texremap/options/part.hpp"
#include "texremap/plan/converter_text.hpp"
#include "texture/content_hash.hpp"

namespace remap {

// A FinishedFile is a finished file before it has its final name.
struct FinishedFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
  std::string hash;
};

// `file` is a finished NewFile or NewImage. It is on the disk when this returns.
template <typename File>
FinishedFile finished_file(const File& file) {
  file.flush_to_disk();
  const auto content = file.content();
  return {file.path(), content->size(), hash_of_file(*content)};
}

// A Journal lets runs of several processes and threads share a folder. A set is renamed and recorded under a
// lock of the folder itself (flock), which ends with its process and leaves no file. Parts need no lock,
// because two runs of one part write the same bytes.
class Journal {
 public:
  // Opens the journal of `folder`, which need not exist, for a run of all sets or of a part.
  Journal(const std::filesystem::path& folder, ConversionNote conversion, const std::optional<Part>& part);
  ~Journal();

  // Throws kOutput, with the difference, if the folder belongs to another conversion.
  void require_own() const;
  // Records that the folder belongs to this conversion, and creates it. Unless `force`, calls require_own().
  void claim(bool force);

  // Returns true if this conversion wrote, or began to write, the file.
  bool is_own(const std::filesystem::path& path) const;
  // Returns true if this conversion wrote all files from `inputs`, and they are unchanged since.
  bool is_done(const std::string& inputs, const std::vector<std::filesystem::path>& files) const;
  // Returns the files that this conversion last wrote for the set, in their order.
  std::vector<std::filesystem::path> files_of(const std::string& set) const;

  // Records that the files of a set are about to appear.
  void begin(const std::vector<std::filesystem::path>& files);
  // Calls `rename` and records the set, both under the lock of the folder. If another run wrote one of the
  // files meanwhile, throws kOutput without calling `rename`, unless `force` is set. If the other run made
  // these files from the same inputs, they are equal, and this call replaces them.
  void commit(const std::string& set, const std::string& inputs, const std::vector<FinishedFile>& files,
              bool force, const std::function<void()>& rename);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// A JournalLookup finds input files in journals. A journal lies in the file's folder or above. Thread-safe.
class JournalLookup {
 public:
  JournalLookup();
  ~JournalLookup();
  // Returns the target model of the conversion that wrote the file, if the file is unchanged since.
  std::optional<std::string> target_of(const InputFile& file);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace remap
