// This file runs the jobs of a conversion, several at once. Sets and assets have workers of their own.
#pragma once

#include <functional>
#include <vector>

#include "texremap/plan/convert_plan.hpp"
#include "texremap/run/job_report.hpp"
#include "texremap/run/output_folder.hpp"

namespace remap {

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
