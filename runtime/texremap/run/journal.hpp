// The journal of an output folder, `.texremap.jsonl`: to which conversion the folder belongs, and what was
// written from which inputs, in any format. Lines of JSON that are only ever appended:
//
//   {"conversion": {"hash": "...", "source": "mitsuba/ward", "target": "mitsuba/as", ...}}   the last one
//   counts
//   {"begun": ["a_rough.tga", ...], "conversion": "HASH"}                                     before the
//   first file
//   {"set": "a", "inputs": "HASH", "conversion": "HASH", "source": ..., "target": ..., "files": [{"name":
//    "a_rough.tga", "bytes": 1234, "hash": "..."}, ...]}                                      after the last
//    one
//
// Names are relative to the folder. A line that cannot be read, such as the last one of a killed run, is
// ignored. A run that converts a part of a manifest writes a journal of its own,
// `.texremap-parts/NAME.journal` (part.hpp): processes of several machines cannot append to one file of a
// shared file system. What such a run finds in its place without a line in its own journal, it looks up in
// all of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/input_file.hpp"
#include "texremap/options/part.hpp"
#include "texremap/plan/conversion_note.hpp"
#include "texture/content_hash.hpp"

namespace remap {

// A finished file before it has its final name.
struct FinishedFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
  std::string hash;
};

// `file`: a NewFile or a NewImage that is finished, and on the disk when this returns.
template <typename File>
FinishedFile finished_file(const File& file) {
  file.flush_to_disk();
  const auto content = file.content();
  return {file.path(), content->size(), hash_of_file(*content)};
}

// Runs of several processes and threads may share a folder: a set is renamed and noted under a lock of the
// folder itself (flock), which ends with its process and leaves no file. Parts need none: two runs of one
// part write the same bytes.
class Journal {
 public:
  // The journal of `folder`, which need not exist, for a run of all sets or of a part.
  Journal(const std::filesystem::path& folder, ConversionNote conversion, const std::optional<Part>& part);
  ~Journal();

  // Throws kOutput, naming the difference, if the folder belongs to another conversion.
  void require_own() const;
  // Notes that the folder belongs to this conversion, and creates it. Throws as require_own() unless `force`.
  void claim(bool force);

  // Whether this conversion wrote, or began to write, the file.
  bool is_own(const std::filesystem::path& path) const;
  // Whether this conversion wrote all files from `inputs`, and they still are what it wrote.
  bool is_done(const std::string& inputs, const std::vector<std::filesystem::path>& files) const;
  // The files that this conversion wrote last of the set, in their order; none where it wrote none.
  std::vector<std::filesystem::path> files_of(const std::string& set) const;

  // Notes that the files of a set are about to appear.
  void begin(const std::vector<std::filesystem::path>& files);
  // Calls `rename` and notes the set, both under the lock of the folder. Throws kOutput, without calling it,
  // if another run wrote one of the files meanwhile, unless `force`; if that run made them from the same
  // inputs, they are whole and equal, and are written again.
  void commit(const std::string& set, const std::string& inputs, const std::vector<FinishedFile>& files,
              bool force, const std::function<void()>& rename);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// What journals say of input files; a journal lies in the folder of the file or in one above. Thread-safe.
class JournalLookup {
 public:
  JournalLookup();
  ~JournalLookup();
  // The target model of the conversion that wrote the file, if the file still is what it wrote.
  std::optional<std::string> target_of(const InputFile& file);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace remap
