// The results of the environments study as tables, a plot and a summary.
#pragma once

#include "study/environments.hpp"
#include "study/study_report.hpp"

namespace remap {

// Tables: environments.csv, one row for each comparison, and environments_summary.csv, the means of each
// method over all of its pairs (`all`) and for each pair. The summary has these means, the pairs for which a
// method is worse than copying (its mean RMSE is larger, or its mean SSIM smaller, by more than half the last
// digit of the text), and the remarks. The plot draws RMSE and SSIM over alpha: means over pairs and
// environments of each method that applies to all pairs.
StudyReport environments_report(const EnvironmentsOptions& options, const EnvironmentsResult& result);

}  // namespace remap
