#include "study/conductors_study.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <set>

#include "match/match.hpp"
#include "renderer/fresnel.hpp"
#include "study/materials.hpp"
#include "system/parallel.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::number_text;

const std::string kConductorSource = "mitsuba/as", kConductorTarget = "mitsuba/ward-conserving";

double reflectance(const Conductor& metal, std::size_t channel) {
  return normal_reflectance({metal.eta[channel], metal.k[channel]});
}

// The least squares line through a set of points.
struct Line {
  double slope = 0.0, offset = 0.0;

  static Line through(const std::vector<std::pair<double, double>>& points) {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    const auto count = static_cast<double>(points.size());
    for (const auto& [px, py] : points) x += px / count, y += py / count;
    for (const auto& [px, py] : points) xx += (px - x) * (px - x), xy += (px - x) * (py - y);
    const double slope = xx > 0.0 ? xy / xx : 0.0;
    return {slope, y - slope * x};
  }
  double at(double x) const { return offset + slope * x; }
};

std::vector<SamplePoint> metal_samples(const StudyOptions& options) {
  std::set<double> f0s;
  for (const Conductor& metal : measured_conductors())
    for (std::size_t c = 0; c < 3; ++c) f0s.insert(reflectance(metal, c));
  std::vector<SamplePoint> samples;
  for (const double alpha : options.alphas)
    for (const double f0 : f0s) samples.push_back({alpha, f0});
  return samples;
}

Material conductor(double alpha, double eta, double k) {
  return {"mitsuba/as-conductor", {{"alpha", {alpha}}, {"eta", {eta}}, {"k", {k}}, {"diffuse", {0.0}}}};
}

// Matches the picture of a metal with exact Fresnel to the target model.
TableRow exact_match(const StudyTarget& target, double alpha, double f0, const std::vector<float>& picture) {
  Matcher matcher(target.bank, {picture}, squared_weights(target.picture_taker.objective(), picture, {}));
  std::vector<std::size_t> minima;
  const Match found = matcher.match({1.0}, &minima);
  return {alpha, f0, found.alpha, found.specular, found.error, found.status, 0};
}

double square_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - b[i], 2);
  return sum;
}

double square_sum(const std::vector<float>& a) {
  double sum = 0.0;
  for (const float value : a) sum += static_cast<double>(value) * value;
  return sum;
}

// Matches one metal at one alpha by its index of refraction, and measures the error of Schlick's
// approximation.
void match_metal(const StudyTarget& target, const ModelDescription& source, const Conductor& metal,
                 double alpha, ConductorRow* rows, FresnelDifference* fresnel) {
  double difference = 0.0, power = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double f0 = reflectance(metal, c);
    const auto exact = target.picture_taker.take(conductor(alpha, metal.eta[c], metal.k[c]));
    const auto schlick = target.picture_taker.take(source, RoleValues{alpha, f0, 0.0});
    difference += square_difference(exact, schlick);
    power += square_sum(exact);
    rows[c].material = metal.name;
    rows[c].channel = c;
    rows[c].f0 = f0;
    rows[c].by_index = exact_match(target, alpha, f0, exact);
  }
  *fresnel = {metal.name, alpha, std::sqrt(difference / power)};
}

void match_exactly(const Renderer& renderer, const StudyOptions& options, ConductorsStudy* study) {
  const StudyTarget target(renderer, kConductorTarget, options);
  const ModelDescription source = renderer.model(kConductorSource);
  const auto metals = measured_conductors();
  const std::size_t tasks = metals.size() * options.alphas.size();
  study->rows.resize(3 * tasks);
  study->fresnel.resize(tasks);
  std::atomic<std::size_t> done{0};
  remap::run_parallel(tasks, options.jobs, [&](std::size_t task) {
    const Conductor& metal = metals[task % metals.size()];
    match_metal(target, source, metal, options.alphas[task / metals.size()], &study->rows[3 * task],
                &study->fresnel[task]);
    if (options.progress)
      options.progress(0.3 + 0.5 * static_cast<double>(++done) / static_cast<double>(tasks));
  });
}

ConductorCurve curve_of(const std::vector<TableRow>& rows, double alpha) {
  ConductorCurve curve;
  curve.alpha = alpha;
  std::vector<std::pair<double, double>> points;
  for (const TableRow& row : rows) {
    if (row.status == RowStatus::kOk) points.emplace_back(row.specular1, row.specular2);
    if (row.status == RowStatus::kOk) curve.ok_alpha += row.alpha2;
    ++(row.status == RowStatus::kOk        ? curve.ok
       : row.status == RowStatus::kClamped ? curve.clamped
                                           : curve.other);
  }
  if (points.size() < 2) return curve;
  curve.ok_alpha /= static_cast<double>(curve.ok);
  const Line line = Line::through(points);
  curve.limit_f0 = (1.0 - line.offset) / line.slope;
  for (const auto& [x, y] : points)
    curve.line_deviation = std::max(curve.line_deviation, std::fabs(line.at(x) - y));
  for (const TableRow& row : rows)
    if (row.status == RowStatus::kClamped)
      curve.clamped_alpha_shift =
          std::max(curve.clamped_alpha_shift, std::fabs(row.alpha2 / curve.ok_alpha - 1.0));
  return curve;
}

std::vector<TableRow> rows_of_alpha(const Table& table, double alpha) {
  std::vector<TableRow> rows;
  for (const TableRow& row : table.rows)
    if (row.alpha1 == alpha) rows.push_back(row);
  return rows;
}

// Converts the usable rows from Ward back to Ashikhmin-Shirley.
void travel_back(const Renderer& renderer, const StudyOptions& options, const SweepExecution& execution,
                 ConductorsStudy* study) {
  const std::vector<TableRow> there = usable_rows(study->there);
  std::vector<SamplePoint> samples;
  for (const TableRow& row : there) samples.push_back({row.alpha2, row.specular2});
  study->back = run_sweep(
      renderer,
      study_sweep_options(kConductorTarget, kConductorSource, std::move(samples), options.resolution),
      execution);
  RoundTrip trip;
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < there.size(); ++i) {
    const TableRow& back = study->back.rows[i];
    if (back.status != RowStatus::kOk) continue;
    points.emplace_back(there[i].specular1, back.specular2);
    trip.f0_deviation = std::max(trip.f0_deviation, std::fabs(back.specular2 - there[i].specular1));
    trip.alpha_deviation = std::max(trip.alpha_deviation, std::fabs(back.alpha2 - there[i].alpha1));
  }
  const Line line = Line::through(points);
  trip.rows = points.size();
  trip.slope = line.slope;
  trip.offset = line.offset;
  study->round_trip = trip;
}

// The largest difference in alpha and specular over the rows that are ok in both tables.
double difference(const Table& a, const Table& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    if (a.rows[i].status == RowStatus::kOk && b.rows[i].status == RowStatus::kOk)
      worst = std::max({worst, std::fabs(a.rows[i].alpha2 - b.rows[i].alpha2),
                        std::fabs(a.rows[i].specular2 - b.rows[i].specular2)});
  return worst;
}

// Assigns to each row of a metal the row of the sweep with the same F0.
void join_rows(ConductorsStudy* study) {
  const auto by_sample = rows_by_sample(study->there);
  for (ConductorRow& row : study->rows) {
    row.by_f0 = *by_sample.at({row.by_index.alpha1, row.f0});
    if (row.by_f0.status == RowStatus::kOk && row.by_index.status == RowStatus::kOk)
      study->exact_specular_shift = std::max(study->exact_specular_shift,
                                             std::fabs(row.by_index.specular2 / row.by_f0.specular2 - 1.0));
  }
}

double mean_error(const std::vector<FresnelDifference>& all) {
  double mean = 0.0;
  for (const FresnelDifference& item : all) mean += item.error / static_cast<double>(all.size());
  return mean;
}

const FresnelDifference& worst_of(const std::vector<FresnelDifference>& all) {
  return *std::ranges::max_element(all, {}, &FresnelDifference::error);
}

std::vector<std::string> conductors_words(const ConductorsStudy& study) {
  std::vector<std::string> words;
  words.push_back(std::to_string(measured_conductors().size()) + " metals, three channels each, " +
                  kConductorSource + " to " + kConductorTarget + ", light at 45 degrees:");
  double deviation = 0.0, shift = 0.0;
  for (const ConductorCurve& curve : study.curves) {
    words.push_back(
        "alpha " + number_text(curve.alpha) + ": " + std::to_string(curve.ok) + " of " +
        std::to_string(curve.ok + curve.clamped + curve.other) + " rows are ok, within " +
        short_text(curve.line_deviation) + " of a straight line in specular; Ward specular reaches 1 at F0 " +
        short_text(curve.limit_f0) + "; above it, " + std::to_string(curve.clamped) +
        " rows are flagged as clamped" +
        (curve.other == 0 ? "" : ", " + std::to_string(curve.other) + " as unstable or flat") +
        (curve.clamped == 0
             ? ""
             : " (target alpha changes by up to " + percent_text(curve.clamped_alpha_shift) + ")"));
    deviation = std::max(deviation, curve.line_deviation);
    shift = std::max(shift, curve.clamped_alpha_shift);
  }
  words.push_back("figure 6: smooth (largest distance from a line " + short_text(deviation) +
                  ") except where Ward specular exceeds 1; every such row is flagged");
  words.push_back("mitsuba/ward, whose specular is limited to 1, gives the same ok rows within " +
                  short_text(study.plain_difference));
  const RoundTrip& trip = study.round_trip;
  words.push_back("figure 7: the " + std::to_string(trip.rows) + " ok rows converted back to " +
                  kConductorSource + ": slope " + short_text(trip.slope, 6) + ", offset " +
                  short_text(trip.offset) + ", F0 within " + short_text(trip.f0_deviation) +
                  ", alpha within " + short_text(trip.alpha_deviation));
  const FresnelDifference& worst = worst_of(study.fresnel);
  words.push_back("Schlick (from F0) against exact Fresnel: pictures differ by " +
                  percent_text(mean_error(study.fresnel)) + " on average, at most " +
                  percent_text(worst.error) + " (" + worst.material + ", alpha " + number_text(worst.alpha) +
                  "); Ward specular differs by at most " + percent_text(study.exact_specular_shift));
  return words;
}

std::string rows_csv(const ConductorsStudy& study) {
  CsvText csv(
      "material,channel,f0,alpha1,alpha2_by_f0,specular2_by_f0,error_by_f0,status_by_f0,alpha2_by_index,"
      "specular2_by_index,error_by_index,status_by_index");
  for (const ConductorRow& row : study.rows) {
    const TableRow &by_f0 = row.by_f0, &by_index = row.by_index;
    csv.add_row(row.material, std::string(1, "rgb"[row.channel]), row.f0, by_f0.alpha1, by_f0.alpha2,
                by_f0.specular2, by_f0.error, status_name(by_f0.status), by_index.alpha2, by_index.specular2,
                by_index.error, status_name(by_index.status));
  }
  return csv.text();
}

std::string fresnel_csv(const ConductorsStudy& study) {
  CsvText csv("material,alpha,schlick_error");
  for (const FresnelDifference& item : study.fresnel) csv.add_row(item.material, item.alpha, item.error);
  return csv.text();
}

std::vector<StudyPlot> conductors_plots(const ConductorsStudy& study) {
  StudyPlot there{"Figure 6: metals, one curve per alpha; open points: flagged",
                  "F0 of " + kConductorSource,
                  "specular of " + kConductorTarget,
                  {}};
  for (const ConductorCurve& curve : study.curves) {
    std::vector<const TableRow*> rows;
    for (const TableRow& row : study.there.rows)
      if (row.alpha1 == curve.alpha) rows.push_back(&row);
    there.add_rows(curve.alpha, rows);
  }
  StudyPlot trip{"Figure 7: round trip", "F0", "F0 after the round trip", {{"ok rows", {}, true}}};
  const std::vector<TableRow> usable = usable_rows(study.there);
  for (std::size_t i = 0; i < usable.size(); ++i)
    trip.curves[0].points.emplace_back(usable[i].specular1, study.back.rows[i].specular2);
  return {there, trip};
}

remap::Json conductors_json(const ConductorsStudy& study) {
  remap::Json curves = remap::Json::list();
  for (const ConductorCurve& curve : study.curves)
    curves.push_back({{"alpha", curve.alpha},
                      {"ok", curve.ok},
                      {"clamped", curve.clamped},
                      {"other", curve.other},
                      {"line_deviation", curve.line_deviation},
                      {"limit_f0", curve.limit_f0},
                      {"clamped_alpha_shift", curve.clamped_alpha_shift}});
  return {{"curves", curves},
          {"round_trip",
           {{"rows", study.round_trip.rows},
            {"slope", study.round_trip.slope},
            {"offset", study.round_trip.offset},
            {"f0_deviation", study.round_trip.f0_deviation},
            {"alpha_deviation", study.round_trip.alpha_deviation}}},
          {"schlick_error", {{"mean", mean_error(study.fresnel)}, {"max", worst_of(study.fresnel).error}}},
          {"exact_specular_shift", study.exact_specular_shift}};
}

}  // namespace

ConductorsStudy study_conductors(const Renderer& renderer, const StudyOptions& options) {
  ConductorsStudy study;
  SweepExecution execution;
  execution.jobs = options.jobs;
  SweepOptions there =
      study_sweep_options(kConductorSource, kConductorTarget, metal_samples(options), options.resolution);
  study.there = run_sweep(renderer, there, execution);
  if (options.progress) options.progress(0.2);
  there.target = "mitsuba/ward";
  study.plain_difference = difference(study.there, run_sweep(renderer, there, execution));
  if (options.progress) options.progress(0.3);
  for (const double alpha : options.alphas)
    study.curves.push_back(curve_of(rows_of_alpha(study.there, alpha), alpha));
  match_exactly(renderer, options, &study);
  join_rows(&study);
  travel_back(renderer, options, execution, &study);
  if (options.progress) options.progress(1.0);
  return study;
}

StudyReport conductors_report(const ConductorsStudy& study) {
  StudyReport report =
      study_report(conductors_words(study), conductors_json(study), "figure6_7.svg", conductors_plots(study));
  report.tables = {{"conductors.csv", rows_csv(study)},
                   {"fresnel.csv", fresnel_csv(study)},
                   {"as_to_ward.csv", table_text(study.there)},
                   {"ward_to_as.csv", table_text(study.back)}};
  return report;
}

}  // namespace remapc
