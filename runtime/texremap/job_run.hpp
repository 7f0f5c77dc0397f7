// Runs the jobs of a conversion: one after another on all threads, or several at once.
#pragma once

#include "texremap/convert_report.hpp"

namespace remap {

// The reports of all sets, in their order. A failing job of a tree is part of its report; that of a single
// set is thrown, and so is kInterrupted.
std::vector<JobReport> run_jobs(const JobList& list, const ChosenConverter& chosen,
                                const ConvertOptions& options);

}  // namespace remap
