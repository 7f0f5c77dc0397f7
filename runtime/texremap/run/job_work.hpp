// The work of a job, for sets and for assets.
#pragma once

#include <functional>
#include <memory>

#include "texremap/run/job_report.hpp"
#include "texremap/run/output_folder.hpp"

namespace remap {

class JobWorker {
 public:
  virtual ~JobWorker() = default;
  // Does the job, from many threads at once, and says in `report` what was done, also before it throws.
  // `progress` receives the finished share, 0 to 1.
  virtual void run(const Job& job, const std::function<void(double)>& progress, JobReport& report) = 0;
};

// Refuses --dither and --compression where sets were converted and none of the results takes them. Throws
// kUsage.
void require_effect(const ConvertPlan& plan, const std::vector<JobReport>& reports);

// `threads`: of each job. `plan` and `folder` must outlive them.
std::unique_ptr<JobWorker> set_worker(const ConvertPlan& plan, OutputFolder& folder, int threads);
std::unique_ptr<JobWorker> asset_worker(const ConvertPlan& plan, OutputFolder& folder);

// The sizes of files on disk; those that are not there count nothing.
std::uintmax_t size_of(const std::vector<std::filesystem::path>& files);

}  // namespace remap
