// This file runs the jobs of a conversion, several at once. Sets and assets have workers of their own. The
// output folder knows which files may be replaced, which are done, and the journal.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "texremap/plan/convert_plan.hpp"
#include "texremap/run/job_report.hpp"
#include "texremap/run/journal.hpp"

namespace remap {

// An OutputFolder has no journal for named assets, because the user's folder may have other files.
class OutputFolder {
 public:
  // Throws kOutput if the folder belongs to another conversion, except with --force. `plan` must outlive it.
  explicit OutputFolder(const ConvertPlan& plan);

  // Throws kOutput, with what to do, unless a file may be written. It may be written if it does not exist, if
  // this conversion of a folder wrote it, or with --force.
  void require_free(const std::filesystem::path& file) const;
  // Reserves the name of a result. Throws kOutput if another job has reserved it.
  void take(const std::filesystem::path& file, const std::string& owner) const;

  // Returns true if hashing the inputs can help, because this conversion wrote the first of the files.
  bool may_be_done(const std::vector<std::filesystem::path>& files) const;
  // Returns true if this conversion wrote all files from `inputs`, and they are unchanged since. Returns
  // false with --force.
  bool is_done(const std::string& inputs, const std::vector<std::filesystem::path>& files) const;
  // Returns the files that this conversion last wrote for an entry.
  std::vector<std::filesystem::path> files_of(const std::string& entry) const;

  // Records that files are about to appear.
  void begin(const std::vector<std::filesystem::path>& files);
  // Calls `rename`, which gives finished files their final names, and records the files. They must be on the
  // disk before this call. It holds the lock of the folder only for the renames.
  void commit(const std::string& entry, const std::string& inputs, const std::vector<FinishedFile>& files,
              const std::function<void()>& rename);
  // Returns true if results are recorded. Results must then be on the disk before they get their final names.
  bool has_journal() const { return journal_.has_value(); }

 private:
  const ConvertPlan& plan_;
  std::optional<Journal> journal_;
};

// Returns the reports of all sets or assets, in order. If there are several, a report holds its failure,
// otherwise the failure is thrown. kInterrupted is always thrown. `finished` is called with each report as
// soon as the set or asset is finished, by one thread at a time. Throws kOutput if the output folder belongs
// to another conversion, and kUsage for an option that applies to no result.
std::vector<JobReport> run_jobs(const ConvertPlan& plan,
                                const std::function<void(const JobReport&)>& finished);

// A JobWorker does a job, from many threads at once. It fills in `report`, even before it throws. `progress`
// receives the finished fraction, 0 to 1.
using JobWorker =
    std::function<void(const Job& job, const std::function<void(double)>& progress, JobReport& report)>;

// Refuses --compression if sets were converted and no result can use it. Throws kUsage.
void require_effect(const ConvertPlan& plan, const std::vector<JobReport>& reports);

// Makes a worker with `threads` for each job. `plan` and `folder` must outlive the worker.
JobWorker set_worker(const ConvertPlan& plan, OutputFolder& folder, int threads);
JobWorker asset_worker(const ConvertPlan& plan, OutputFolder& folder);

// Returns the sizes of files on disk. Missing files count as 0.
std::uintmax_t size_of(const std::vector<std::filesystem::path>& files);

}  // namespace remap
