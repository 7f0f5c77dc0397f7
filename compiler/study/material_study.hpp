// Parts of the study of dielectrics: sweeps with light at 45 degrees and uniform weights, the
// setting of section 4.1 of the paper, reports and plots.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "match/target_bank.hpp"
#include "study/study_report.hpp"
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

// A target model in this setting, with a bank for alphas from a quarter of the least of the study.
struct StudyTarget {
  StudyTarget(const Renderer& renderer, const std::string& name, const StudyOptions& options);

  PictureTaker picture_taker;
  remap::Range alphas;
  ProbedModel model;
  TargetBank bank;
};

// The rows of a table by their source alpha and specular.
std::map<std::pair<double, double>, const TableRow*> rows_by_sample(const Table& table);

// The curves of one plot, by their labels and axes.
struct StudyPlot {
  struct Curve {
    std::string label;
    std::vector<std::pair<double, double>> points;
    bool flagged = false;  // rows that a fit would ignore; drawn as open points without a line
  };
  std::string title, x_label, y_label;
  std::vector<Curve> curves;

  // Adds target specular over source specular of rows of one alpha: a curve of the ok rows and a flagged one.
  void add_rows(double alpha, const std::vector<const TableRow*>& rows);
};

// A report of findings, one sentence each, which the figures repeat as `words`; its plot draws `plots` side
// by side.
StudyReport study_report(const std::vector<std::string>& words, remap::Json figures,
                         const std::string& plot_name, const std::vector<StudyPlot>& plots);

// Formats a share as a percentage, rounded to three significant digits: `0.123 %`.
std::string percent_text(double share);

}  // namespace remapc
