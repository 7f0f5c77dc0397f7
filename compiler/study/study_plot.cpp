#include "study/study_plot.hpp"

#include <sstream>

#include "report/gnuplot.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::number_text;

constexpr int kPanelWidth = 640, kHeight = 480;

// Writes one data block for each curve.
void write_data(const StudyPlot& plot, std::size_t panel, std::ostringstream& out) {
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    out << "$data" << panel << "_" << c << " << EOD\n";
    for (const auto& [x, y] : plot.curves[c].points) out << number_text(x) << ' ' << number_text(y) << '\n';
    out << "EOD\n";
  }
}

// A flagged curve has the color of the curve before it, because it continues that curve. gnuplot rejects
// empty curves.
void write_curves(const StudyPlot& plot, std::size_t panel, std::ostringstream& out) {
  out << "set title \"" << plot.title << "\" noenhanced\nset xlabel \"" << plot.x_label
      << "\" noenhanced\nset ylabel \"" << plot.y_label << "\" noenhanced\nplot ";
  std::size_t color = 0;
  bool first = true;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const StudyCurve& curve = plot.curves[c];
    if (!curve.flagged && c > 0) ++color;
    if (curve.points.empty()) continue;
    out << (first ? "" : ", ") << "$data" << panel << "_" << c << " using 1:2 with "
        << (curve.flagged ? "points pointtype 6" : "linespoints pointtype 7")
        << " pointsize 0.4 linecolor rgb '" << kPlotColors[color % kPlotColors.size()] << "' title \""
        << curve.label << "\"";
    first = false;
  }
  out << "\n";
}

}  // namespace

std::string study_plot_script(const std::vector<StudyPlot>& plots) {
  std::ostringstream out;
  for (std::size_t p = 0; p < plots.size(); ++p) write_data(plots[p], p, out);
  out << plot_style(kPanelWidth * static_cast<int>(plots.size()), kHeight) << "set multiplot layout 1,"
      << plots.size() << "\nset key left top font ',11' noenhanced\n";
  for (std::size_t p = 0; p < plots.size(); ++p) write_curves(plots[p], p, out);
  out << "unset multiplot\n";
  return out.str();
}

}  // namespace remapc
