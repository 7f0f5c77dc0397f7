// Draws the curves of a study as one SVG.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace remapc {

struct StudyCurve {
  std::string label;
  std::vector<std::pair<double, double>> points;
  bool flagged = false;  // rows that a fit would ignore; drawn as open points without a line
};

struct StudyPlot {
  std::string title, x_label, y_label;
  std::vector<StudyCurve> curves;
};

// Writes `plots` side by side. Returns false and writes nothing if gnuplot is missing. Throws kOutput if
// gnuplot fails or the file cannot be written.
bool write_study_plot(const std::filesystem::path& path, const std::vector<StudyPlot>& plots);

}  // namespace remapc
