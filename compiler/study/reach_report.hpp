// The report of the reach study.
#pragma once

#include "study/reach.hpp"
#include "study/study_report.hpp"

namespace remap {

StudyReport reach_report(const ReachOptions& options, const std::vector<FitReach>& result);

}  // namespace remap
