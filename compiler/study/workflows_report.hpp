// The results of the workflows study as text, tables and a plot.
#pragma once

#include <string>
#include <vector>

#include "study/round_trip.hpp"
#include "study/workflows.hpp"

namespace remapc {

// The groups that have materials, in the order of MaterialGroup.
std::vector<MaterialGroup> groups_of(const WorkflowsOptions& options);

// The tables as text, one line for each method.
std::string workflows_text(const WorkflowsOptions& options, const WorkflowsResult& result,
                           const std::vector<FamilyLine>& family);

// CSV: one row for each convention, material and method, with the material, the result, and RMSE and SSIM
// under the headlight and as means over the environments.
std::string workflow_materials_csv(const WorkflowsOptions& options, const WorkflowsResult& result);

// CSV: the figures of each method over all materials (`all`) and over each group.
std::string workflow_summary_csv(const WorkflowsOptions& options, const WorkflowsResult& result);

// A gnuplot script that draws RMSE and SSIM of the plain methods for each group as SVG.
std::string workflows_plot_script(const WorkflowsOptions& options, const WorkflowsResult& result);

}  // namespace remapc
