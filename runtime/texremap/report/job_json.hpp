// This file writes the outcome of a run as JSON.
#pragma once

#include <string_view>
#include <vector>

#include "core/json.hpp"
#include "core/system.hpp"
#include "texremap/plan/convert_plan.hpp"
#include "texremap/run/job_report.hpp"

namespace remap {

// An Outcome holds the reports, the time and the use of resources of a whole run.
struct Outcome {
  const ConvertPlan& plan;
  std::vector<JobReport> reports;
  double seconds = 0.0;
  ResourceUse used;

  ColorNotes colors() const;         // color spaces of all sets
  std::size_t failed_count() const;  // failed entries, and failures among the skipped entries
};

// Returns `converted`, `planned`, `done before` or `failed`.
std::string_view state_text(const ConvertPlan& plan, const JobReport& report);

// Returns converter and path for texture sets, and the target for assets.
Json conversion_json(const ConvertPlan& plan);
// Returns the JSON object for a set or an asset.
Json job_json(const ConvertPlan& plan, const JobReport& report);
Json summary_json(const Outcome& outcome);
// Returns colors, instruction set, time and memory.
Json run_json(const Outcome& outcome);

}  // namespace remap
