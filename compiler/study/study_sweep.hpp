// Sweep options for the studies of measured materials: light at 45 degrees and uniform weights, the setting
// of section 4.1 of the paper.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sweep/sweep.hpp"

namespace remapc {

struct StudyOptions {
  int resolution = 256;
  std::vector<double> alphas;                  // in increasing order
  unsigned jobs = 0;                           // threads; 0: one per core
  std::function<void(double share)> progress;  // share done, 0 to 1; called from any thread
};

SweepOptions study_sweep_options(const std::string& source, const std::string& target,
                                 std::vector<SamplePoint> samples, int resolution);

// Formats a share as a percentage, rounded to three significant digits: `0.123 %`.
std::string percent_text(double share);

// Formats a number, rounded to `digits` significant digits.
std::string short_text(double value, int digits = 3);

}  // namespace remapc
