// Sweeps as the studies of materials take them: light at 45 degrees and uniform weights, the setting of
// section 4.1 of the paper.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sweep/sweep.hpp"

namespace remapc {

struct StudyOptions {
  int resolution = 256;
  std::vector<double> alphas;                  // rising
  unsigned jobs = 0;                           // 0: one a core
  std::function<void(double share)> progress;  // 0 to 1, called from any thread
};

SweepOptions study_sweep_options(const std::string& source, const std::string& target,
                                 std::vector<SamplePoint> samples, int resolution);

// A percentage with three significant digits, rounded: `0.123 %`.
std::string percent_text(double share);

// A number with `digits` significant digits.
std::string short_text(double value, int digits = 3);

}  // namespace remapc
