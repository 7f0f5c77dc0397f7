// What the study of workflows found, as tables, a plot and words.
#pragma once

#include <string>
#include <vector>

#include "study/round_trip.hpp"
#include "study/workflows.hpp"

namespace remapc {

// The groups that have materials, in their order.
std::vector<MaterialGroup> groups_of(const WorkflowsOptions& options);

// The tables as text, a line a method.
std::string workflows_text(const WorkflowsOptions& options, const WorkflowsResult& result,
                           const std::vector<FamilyLine>& family);

// CSV: a row for each convention, material and method: the material, what it became, RMSE and SSIM as means
// over the environments and under the headlight.
std::string workflow_materials_csv(const WorkflowsOptions& options, const WorkflowsResult& result);

// CSV: the figures of each method, over all materials (`all`) and for each group.
std::string workflow_summary_csv(const WorkflowsOptions& options, const WorkflowsResult& result);

// A script for gnuplot that draws RMSE and SSIM of the plain methods for each group as SVG.
std::string workflows_plot_script(const WorkflowsOptions& options, const WorkflowsResult& result);

}  // namespace remapc
