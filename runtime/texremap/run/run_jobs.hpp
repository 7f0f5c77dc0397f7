// This file runs the jobs of a conversion, several at once.
#pragma once

#include <functional>
#include <vector>

#include "texremap/plan/convert_plan.hpp"
#include "texremap/run/job_report.hpp"

namespace remap {

// Returns the reports of all sets or assets, in order. If there are several, a report holds its failure,
// otherwise the failure is thrown. kInterrupted is always thrown. `finished` is called with each report as
// soon as the set or asset is finished, by one thread at a time. Throws kOutput if the output folder belongs
// to another conversion, and kUsage for an option that applies to no result.
std::vector<JobReport> run_jobs(const ConvertPlan& plan,
                                const std::function<void(const JobReport&)>& finished);

}  // namespace remap
