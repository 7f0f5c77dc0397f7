// This file writes the report of a conversion as one HTML file, which shows materials before and after it.
#pragma once

#include <vector>

#include "texremap/plan/convert_plan.hpp"
#include "texremap/run/job_report.hpp"

namespace remap {

// Writes `plan.report`, about a finished conversion or a dry run (docs/report.md). It shows the first 16
// materials. One material has maps of at most 1024 texels a side, more materials have smaller ones. What
// cannot be shown becomes a note. If nothing can be shown, it prints a warning and writes nothing. Throws
// kOutput.
void write_report_page(const ConvertPlan& plan, const std::vector<JobReport>& reports);

}  // namespace remap
