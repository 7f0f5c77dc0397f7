#include "study/material_study.hpp"

#include <cmath>
#include <sstream>

#include "probe/probe.hpp"
#include "report/gnuplot.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::number_text;

const Objective kObjective{{Light{45.0, 3.0}}, Weighting::kUniform, 0.1};
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
    const StudyPlot::Curve& curve = plot.curves[c];
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

std::string plot_script(const std::vector<StudyPlot>& plots) {
  std::ostringstream out;
  for (std::size_t p = 0; p < plots.size(); ++p) write_data(plots[p], p, out);
  out << plot_style(kPanelWidth * static_cast<int>(plots.size()), kHeight) << "set multiplot layout 1,"
      << plots.size() << "\nset key left top font ',11' noenhanced\n";
  for (std::size_t p = 0; p < plots.size(); ++p) write_curves(plots[p], p, out);
  out << "unset multiplot\n";
  return out.str();
}

}  // namespace

SweepOptions study_sweep_options(const std::string& source, const std::string& target,
                                 std::vector<SamplePoint> samples, int resolution) {
  SweepOptions options;
  options.source = source;
  options.target = target;
  options.objective = kObjective;
  options.objective_name = "custom";
  options.resolution = resolution;
  options.sampling = std::to_string(samples.size()) + " of a study";
  options.samples = std::move(samples);
  return options;
}

StudyTarget::StudyTarget(const Renderer& renderer, const std::string& name, const StudyOptions& options)
    : picture_taker(renderer, kObjective, options.resolution, 1),
      alphas{options.alphas.front() / 4.0, renderer.model(name).alpha.max},
      model{renderer.model(name), probe_specular(picture_taker, renderer.model(name), alphas)},
      bank(picture_taker, model, alphas, kBankRatio) {}

std::map<std::pair<double, double>, const TableRow*> rows_by_sample(const Table& table) {
  std::map<std::pair<double, double>, const TableRow*> rows;
  for (const TableRow& row : table.rows) rows[{row.alpha1, row.specular1}] = &row;
  return rows;
}

void StudyPlot::add_rows(double alpha, const std::vector<const TableRow*>& rows) {
  Curve ok{"alpha " + number_text(alpha), {}, false}, flagged{"", {}, true};
  for (const TableRow* row : rows)
    (row->status == RowStatus::kOk ? ok : flagged).points.emplace_back(row->specular1, row->specular2);
  if (ok.points.empty()) flagged.label = ok.label;
  curves.insert(curves.end(), {ok, flagged});
}

StudyReport study_report(const std::vector<std::string>& words, remap::Json figures,
                         const std::string& plot_name, const std::vector<StudyPlot>& plots) {
  StudyReport report{"", std::move(figures), {}, plot_name, plot_script(plots), {}};
  for (const std::string& sentence : words) report.summary += sentence + "\n";
  report.figures["words"] = words;
  return report;
}

std::string percent_text(double share) {
  const double value = 100.0 * share;
  if (value == 0.0 || !std::isfinite(value)) return number_text(value) + " %";
  const double unit = std::pow(10.0, 2 - static_cast<int>(std::floor(std::log10(std::fabs(value)))));
  return number_text(unit >= 1.0 ? std::round(value * unit) / unit
                                 : std::round(value * unit) * (1.0 / unit)) +
         " %";
}

}  // namespace remapc
