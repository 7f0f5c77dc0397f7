// Runs the jobs of a conversion: one after another on all threads, or several at once.
#pragma once

#include "texremap/convert_report.hpp"

namespace remap {

// Returns the reports of all sets, in order. In a tree, the report of a set holds its failure; the failure of
// a single set is thrown. kInterrupted is always thrown.
std::vector<JobReport> run_jobs(const JobList& list, const ChosenConverter& chosen,
                                const ConvertOptions& options);

}  // namespace remap
