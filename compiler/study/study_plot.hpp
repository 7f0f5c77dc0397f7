// Draws the curves of a study as one SVG.
#pragma once

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

// A gnuplot script that draws `plots` side by side as SVG.
std::string study_plot_script(const std::vector<StudyPlot>& plots);

}  // namespace remapc
