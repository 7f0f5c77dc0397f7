// The results of the workflows study as text, tables and a plot.
#pragma once

#include <string>
#include <vector>

#include "study/study_report.hpp"
#include "study/workflows.hpp"

namespace remap {

// Tables: workflows.csv, one row for each convention, material and method, with the material, the result, and
// RMSE and SSIM under the headlight and as means over the environments; and workflows_summary.csv, the
// figures of each method over all materials (`all`) and over each group. The summary has one line for each
// method, and `remarks`. The plot draws RMSE and SSIM of the plain methods for each group.
StudyReport workflows_report(const WorkflowsOptions& options, const WorkflowsResult& result,
                             const std::vector<FamilyLine>& family, const std::vector<std::string>& remarks);

}  // namespace remap
