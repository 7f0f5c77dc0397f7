// The results of the warps study as text, tables, a plot and contact sheets.
#pragma once

#include "study/study_report.hpp"
#include "study/warps.hpp"

namespace remapc {

// Tables: warp.csv, one row for each set, set of strokes and variant, with empty cells for variants without a
// warp; and warp_sensitivity.csv, the distance between the results of two sets of strokes, one row for each
// set, variant and pair. The summary has the means over sets and strokes, one line for each variant, an
// explanation of the columns, and the legends of the sheets, which are drawn for a study with pictures. The
// plot draws the error of methods and dimensions, and over points and nodes.
StudyReport warps_report(const WarpsOptions& options, const WarpsResult& result);

}  // namespace remapc
