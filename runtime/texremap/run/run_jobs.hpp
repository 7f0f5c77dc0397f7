// Runs the jobs of a conversion, several at once.
#pragma once

#include <functional>
#include <vector>

#include "texremap/plan/convert_plan.hpp"
#include "texremap/run/job_report.hpp"

namespace remap {

// Returns the reports of all sets or assets, in order. Where there are several, a report holds its failure;
// that of a single one is thrown. kInterrupted is always thrown. `finished` is called with each report as
// soon as the set or asset is finished, by one thread at a time. Throws kOutput if the output folder belongs
// to another conversion; kUsage for an option that applies to none of the results.
std::vector<JobReport> run_jobs(const ConvertPlan& plan,
                                const std::function<void(const JobReport&)>& finished);

}  // namespace remap
