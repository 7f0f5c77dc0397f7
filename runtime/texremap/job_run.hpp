// Runs the jobs of a conversion: one after another on all threads, or several at once.
#pragma once

#include <functional>
#include <vector>

#include "texremap/convert_report.hpp"

namespace remap {

// Returns the reports of all sets, in order. In a tree, the report of a set holds its failure; the failure of
// a single set is thrown. kInterrupted is always thrown. `finished` is called with the report of each set as
// soon as the set is finished, by one thread at a time. A folder's run claims its output folder
// (journal.hpp): kOutput if that belongs to another conversion.
std::vector<JobReport> run_jobs(const JobList& list, const ChosenConverter& chosen,
                                const ConvertOptions& options,
                                const std::function<void(const JobReport&)>& finished);

}  // namespace remap
