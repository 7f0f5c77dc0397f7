// The output folder of a run: which files may be replaced, which are done, and the journal.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "texremap/plan/convert_plan.hpp"
#include "texremap/run/journal.hpp"

namespace remap {

// Named assets have no journal: the user chose their place, and other files may be there.
class OutputFolder {
 public:
  // `plan` must outlive it. Throws kOutput if the folder belongs to another conversion, unless --force is
  // given.
  explicit OutputFolder(const ConvertPlan& plan);

  // Decides whether a file may be written: if it does not exist, if this conversion of a folder wrote it, or
  // with --force. Otherwise throws kOutput, with what to do.
  void require_free(const std::filesystem::path& file) const;
  // Takes the name of a result. Throws kOutput where another job has it.
  void take(const std::filesystem::path& file, const std::string& owner) const;

  // Whether hashing the inputs can tell anything: this conversion wrote the first of the files.
  bool may_be_done(const std::vector<std::filesystem::path>& files) const;
  // Whether this conversion wrote all files from `inputs`, and they still are what it wrote; never with
  // --force.
  bool is_done(const std::string& inputs, const std::vector<std::filesystem::path>& files) const;
  // The files that this conversion wrote last of an entry.
  std::vector<std::filesystem::path> files_of(const std::string& entry) const;

  // Notes that files are about to appear.
  void begin(const std::vector<std::filesystem::path>& files);
  // Calls `rename`, which gives finished files their names, and notes them. They are on the disk before; the
  // lock of the folder is held for the renames only.
  void commit(const std::string& entry, const std::string& inputs, const std::vector<FinishedFile>& files,
              const std::function<void()>& rename);
  // Whether results are noted, and so on the disk before they have their names.
  bool has_journal() const { return journal_.has_value(); }

 private:
  const ConvertPlan& plan_;
  std::optional<Journal> journal_;
};

}  // namespace remap
