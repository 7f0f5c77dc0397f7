#include "study/study_plot.hpp"

#include <array>
#include <sstream>

#include "remap/error.hpp"
#include "report/gnuplot.hpp"
#include "system/files.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::number_text;

// Colors that differ for color-blind eyes too (Okabe and Ito 2008).
constexpr std::array<const char*, 6> kColors = {"#0072B2", "#D55E00", "#009E73",
                                                "#CC79A7", "#E69F00", "#56B4E9"};
constexpr int kPanelWidth = 640, kHeight = 480;

bool has_gnuplot() {
  try {
    require_gnuplot();
    return true;
  } catch (const remap::Error&) {
    return false;
  }
}

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
        << " pointsize 0.4 linecolor rgb '" << kColors[color % kColors.size()] << "' title \"" << curve.label
        << "\"";
    first = false;
  }
  out << "\n";
}

}  // namespace

bool write_study_plot(const std::filesystem::path& path, const std::vector<StudyPlot>& plots) {
  if (!has_gnuplot()) return false;
  std::ostringstream out;
  for (std::size_t p = 0; p < plots.size(); ++p) write_data(plots[p], p, out);
  out << "set terminal svg size " << kPanelWidth * static_cast<int>(plots.size()) << "," << kHeight
      << " enhanced font 'Helvetica,13' background rgb 'white'\n"
      << "set multiplot layout 1," << plots.size() << "\n"
      << "set grid linecolor rgb '#dddddd' linetype 1\nset border linecolor rgb '#888888'\n"
      << "set tics textcolor rgb 'black'\nset key left top font ',11' noenhanced\n";
  for (std::size_t p = 0; p < plots.size(); ++p) write_curves(plots[p], p, out);
  out << "unset multiplot\n";
  remap::write_file(path, run_gnuplot(out.str()));
  return true;
}

}  // namespace remapc
