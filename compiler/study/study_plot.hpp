// Curves of a study as one SVG.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace remapc {

struct StudyCurve {
  std::string label;
  std::vector<std::pair<double, double>> points;
  bool flagged = false;  // drawn as open points without a line: rows that a fit would leave out
};

struct StudyPlot {
  std::string title, x_label, y_label;
  std::vector<StudyCurve> curves;
};

// Writes `plots` side by side. False, and nothing is written, where gnuplot is missing. Throws kOutput where
// it fails or the file cannot be written.
bool write_study_plot(const std::filesystem::path& path, const std::vector<StudyPlot>& plots);

}  // namespace remapc
