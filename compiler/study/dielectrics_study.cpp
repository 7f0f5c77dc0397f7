#include "study/dielectrics_study.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <set>

#include "match/joint_match.hpp"
#include "study/materials.hpp"
#include "system/parallel.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::number_text;

const std::string kSource = "mitsuba/as-dielectric", kTarget = "mitsuba/ward";
constexpr remap::Range kIors{1.05, 2.5};
constexpr std::size_t kIorCount = 30;  // 0.05 apart
constexpr double kLostError = 1.01;  // times the best known error: a match above it ended in another minimum
constexpr double kSameError = 1e-4;  // smaller errors are rounding of the pictures

// All combinations of narrow, middle and wide alpha, least and largest specular, dark and bright diffuse.
std::vector<RoleValues> trial_guesses() {
  std::vector<RoleValues> guesses;
  for (const double alpha : {0.02, 0.3, 0.98})
    for (const double specular : {0.0, 1.0})
      for (const double diffuse : {0.0, 1.0}) guesses.push_back({alpha, specular, diffuse});
  return guesses;
}

double grid_ior(std::size_t i) {
  return std::round(1e6 * (kIors.min + (kIors.max - kIors.min) * static_cast<double>(i) /
                                           static_cast<double>(kIorCount - 1))) /
         1e6;
}

// The uniform grid of indices and the indices of the measured materials.
std::vector<SamplePoint> dielectric_samples(const StudyOptions& options) {
  std::set<double> iors;
  for (std::size_t i = 0; i < kIorCount; ++i) iors.insert(grid_ior(i));
  for (const Dielectric& material : measured_dielectrics()) iors.insert(material.ior);
  std::vector<SamplePoint> samples;
  for (const double alpha : options.alphas)
    for (const double ior : iors) samples.push_back({alpha, ior});
  return samples;
}

// The rows of the uniform grid at one alpha.
std::vector<const TableRow*> grid_rows(const Table& table, double alpha) {
  const auto rows = rows_by_sample(table);
  std::vector<const TableRow*> grid;
  for (std::size_t i = 0; i < kIorCount; ++i) grid.push_back(rows.at({alpha, grid_ior(i)}));
  return grid;
}

double specular_range(const std::vector<const TableRow*>& rows) {
  const auto [low, high] = std::ranges::minmax_element(rows, {}, &TableRow::specular2);
  return (*high)->specular2 - (*low)->specular2;
}

DielectricCurve curve_of(const std::vector<Table>& stages, int stage_count, double alpha) {
  const auto rows = grid_rows(stages[static_cast<std::size_t>(stage_count - 1)], alpha);
  const auto two = grid_rows(stages[1], alpha);
  const double range = specular_range(two);
  DielectricCurve curve;
  curve.stages = stage_count;
  curve.alpha = alpha;
  curve.rows = rows.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    curve.mean_error += rows[i]->error / static_cast<double>(rows.size());
    curve.worst_error = std::max(curve.worst_error, rows[i]->error);
    curve.unstable += rows[i]->status == RowStatus::kUnstable ? 1 : 0;
    curve.clamped += status_name(rows[i]->status) == "clamped" ? 1 : 0;
    curve.least_highlight = std::min(curve.least_highlight, rows[i]->specular2 / two[i]->specular2);
    if (i == 0) continue;
    const double step = std::fabs(rows[i]->specular2 - rows[i - 1]->specular2) / range;
    if (step > curve.largest_step) curve.step_ior = rows[i]->specular1;
    curve.largest_step = std::max(curve.largest_step, step);
    if (i + 1 == rows.size()) continue;
    const double second = rows[i + 1]->specular2 - 2.0 * rows[i]->specular2 + rows[i - 1]->specular2;
    curve.second_difference = std::max(curve.second_difference, std::fabs(second) / range);
  }
  return curve;
}

// The image errors of one sample, one for each guess.
using Errors = std::vector<double>;

// Runs the one-stage match from every trial guess, for each alpha and grid index.
std::map<std::pair<double, double>, Errors> try_guesses(const Renderer& renderer, const StudyOptions& options,
                                                        double diffuse) {
  const StudyTarget target(renderer, kTarget, options);
  const ModelDescription source = renderer.model(kSource);
  const BankPictures pictures(target.picture_taker, target.model, target.bank);
  const std::vector<RoleValues> guesses = trial_guesses();
  std::vector<Errors> found(options.alphas.size() * kIorCount);
  std::atomic<std::size_t> done{0};
  remap::run_parallel(found.size(), options.jobs, [&](std::size_t task) {
    const RoleValues role_values{options.alphas[task / kIorCount], grid_ior(task % kIorCount), diffuse};
    auto picture = target.picture_taker.take(source, role_values);
    auto weights = squared_weights(target.picture_taker.objective(), picture, {});
    const JointMatcher matcher(pictures, {{std::move(picture), std::move(weights)}}, {true, diffuse > 0.0});
    for (const RoleValues& guess : guesses)
      found[task].push_back(matcher.match({matcher.point_of(guess)}).error);
    if (options.progress)
      options.progress(0.6 + 0.4 * static_cast<double>(++done) / static_cast<double>(found.size()));
  });
  std::map<std::pair<double, double>, Errors> by_sample;
  for (std::size_t task = 0; task < found.size(); ++task)
    by_sample[{options.alphas[task / kIorCount], grid_ior(task % kIorCount)}] = found[task];
  return by_sample;
}

std::vector<GuessTrial> judge_guesses(const std::map<std::pair<double, double>, Errors>& errors,
                                      const Table& three, const std::vector<double>& alphas) {
  const std::vector<RoleValues> guesses = trial_guesses();
  std::vector<GuessTrial> trials;
  for (const double alpha : alphas) {
    const std::vector<const TableRow*> rows = grid_rows(three, alpha);
    for (std::size_t g = 0; g < guesses.size(); ++g) {
      GuessTrial trial{guesses[g], alpha, rows.size(), 0, 0.0, 0.0, 0};
      bool before = false;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool lost =
            errors.at({alpha, rows[i]->specular1})[g] > kLostError * rows[i]->error + kSameError;
        trial.jumps += i > 0 && lost != before ? 1 : 0;
        before = lost;
        if (!lost) continue;
        if (trial.lost++ == 0) trial.first_lost_ior = rows[i]->specular1;
        trial.last_lost_ior = rows[i]->specular1;
      }
      trials.push_back(trial);
    }
  }
  return trials;
}

void compare_stages(const std::vector<double>& alphas, DielectricsStudy* study) {
  std::size_t rows = 0;
  for (const double alpha : alphas) {
    const auto two = grid_rows(study->stages[1], alpha), three = grid_rows(study->stages[2], alpha);
    const double range = specular_range(two);
    for (std::size_t i = 0; i < two.size(); ++i, ++rows) {
      study->error_gain += 1.0 - three[i]->error / two[i]->error;
      study->worst_difference =
          std::max(study->worst_difference, std::fabs(three[i]->specular2 - two[i]->specular2) / range);
    }
  }
  study->error_gain /= static_cast<double>(rows);
}

const char* stages_name(int stages) {
  return stages == 1 ? "one stage" : stages == 2 ? "two stages" : "three stages";
}

std::string guess_text(const RoleValues& guess) {
  return "(" + number_text(guess.alpha) + ", " + number_text(guess.specular) + ", " +
         number_text(guess.diffuse) + ")";
}

std::string curve_words(const DielectricCurve& curve) {
  return std::string(stages_name(curve.stages)) + ", alpha " + number_text(curve.alpha) + ": " +
         (curve.loses_highlight() ? "loses the highlight"
          : curve.jumps()         ? "jumps"
                                  : "smooth") +
         "; largest second difference " + percent_text(curve.second_difference) + " and largest step " +
         percent_text(curve.largest_step) + " (at ior " + number_text(curve.step_ior) +
         ") of the two-stage range; specular at least " + percent_text(curve.least_highlight) +
         " of two stages; image error " + percent_text(curve.mean_error) + " mean, " +
         percent_text(curve.worst_error) + " largest; of " + std::to_string(curve.rows) + " rows " +
         std::to_string(curve.unstable) + " unstable, " + std::to_string(curve.clamped) + " clamped";
}

std::ptrdiff_t losing_count(const std::vector<GuessTrial>& trials) {
  return std::ranges::count_if(trials, [](const GuessTrial& trial) { return trial.lost > 0; });
}

std::ptrdiff_t jumping_count(const std::vector<GuessTrial>& trials) {
  return std::ranges::count_if(trials, [](const GuessTrial& trial) { return trial.jumps > 0; });
}

// Describes the one-stage match from guesses other than its own.
void add_guess_words(const DielectricsStudy& study, std::vector<std::string>* words) {
  const GuessTrial* example = nullptr;
  for (const GuessTrial& trial : study.trials)
    if (trial.jumps > 0 && (example == nullptr || trial.jumps < example->jumps)) example = &trial;
  words->push_back("one stage from " + std::to_string(trial_guesses().size()) +
                   " other fixed guesses at each alpha: " + std::to_string(losing_count(study.trials)) +
                   " of " + std::to_string(study.trials.size()) +
                   " curves miss the best minimum at some index, " +
                   std::to_string(jumping_count(study.trials)) + " of them with a jump along the index");
  if (example != nullptr)
    words->push_back("example of a jump: guess " + guess_text(example->guess) +
                     " (shares of the ranges of alpha, specular, diffuse) at alpha " +
                     number_text(example->alpha) + " ends in a worse minimum at ior " +
                     number_text(example->first_lost_ior) + " to " + number_text(example->last_lost_ior) +
                     " (" + std::to_string(example->lost) + " of " + std::to_string(example->rows) +
                     " rows)");
}

std::set<double> alphas_of(const Table& table) {
  std::set<double> alphas;
  for (const TableRow& row : table.rows) alphas.insert(row.alpha1);
  return alphas;
}

StudyPlot stage_plot(const Table& table, int stages) {
  StudyPlot plot{std::string(stages == 1   ? "Figure 8"
                             : stages == 2 ? "Figure 10a"
                                           : "Figure 10b") +
                     ": " + stages_name(stages) + "; open points: flagged",
                 "ior of " + kSource,
                 "specular of " + kTarget,
                 {}};
  for (const double alpha : alphas_of(table)) plot.add_rows(alpha, grid_rows(table, alpha));
  return plot;
}

std::string materials_csv(const Table& two) {
  const auto rows = rows_by_sample(two);
  CsvText csv("material,ior,alpha1,alpha2,specular2,diffuse2,error,status");
  for (const Dielectric& material : measured_dielectrics())
    for (const double alpha : alphas_of(two)) {
      const TableRow& row = *rows.at({alpha, material.ior});
      csv.add_row(material.name, material.ior, alpha, row.alpha2, row.specular2, row.diffuse2, row.error,
                  status_name(row.status));
    }
  return csv.text();
}

std::string trials_csv(const std::vector<GuessTrial>& trials) {
  CsvText csv("alpha1,guess_alpha,guess_specular,guess_diffuse,rows,lost,jumps,first_lost_ior,last_lost_ior");
  for (const GuessTrial& trial : trials)
    csv.add_row(trial.alpha, trial.guess.alpha, trial.guess.specular, trial.guess.diffuse, trial.rows,
                trial.lost, trial.jumps, trial.first_lost_ior, trial.last_lost_ior);
  return csv.text();
}

std::vector<std::string> dielectrics_words(const DielectricsStudy& study) {
  std::vector<std::string> words;
  words.push_back(kSource + " to " + kTarget + ", ior " + number_text(kIors.min) + " to " +
                  number_text(kIors.max) + ", diffuse " + number_text(study.diffuse) +
                  ", light at 45 degrees:");
  for (const DielectricCurve& curve : study.curves) words.push_back(curve_words(curve));
  std::string jumps, losing;
  std::array<std::size_t, 3> unstable{};
  for (const DielectricCurve& curve : study.curves) {
    const auto stage = static_cast<std::size_t>(curve.stages - 1);
    if (curve.stages == 1 && curve.jumps())
      jumps += (jumps.empty() ? "alpha " : ", alpha ") + number_text(curve.alpha) + " (ior " +
               number_text(curve.step_ior) + ")";
    if (curve.stages == 1 && curve.loses_highlight())
      losing += (losing.empty() ? "; it loses the highlight at alpha " : ", ") + number_text(curve.alpha);
    unstable[stage] += curve.unstable;
  }
  words.push_back(
      "figure 8 (a jump in one stage; near ior 1.3 in the paper, which states neither alpha nor "
      "guess): " +
      (jumps.empty() ? std::string("not found") : "found at " + jumps) +
      " from the guess in the middle of the ranges" + losing);
  add_guess_words(study, &words);
  words.push_back("figure 10: three stages lower the image error of two stages by " +
                  percent_text(study.error_gain) + " on average and change specular by up to " +
                  percent_text(study.worst_difference) + " of its range");
  words.push_back("unstable rows: " + std::to_string(unstable[0]) + " in one stage, " +
                  std::to_string(unstable[1]) + " in two, " + std::to_string(unstable[2]) + " in three");
  return words;
}

remap::Json dielectrics_json(const DielectricsStudy& study) {
  remap::Json curves = remap::Json::list();
  for (const DielectricCurve& curve : study.curves)
    curves.push_back({{"stages", curve.stages},
                      {"alpha", curve.alpha},
                      {"second_difference", curve.second_difference},
                      {"largest_step", curve.largest_step},
                      {"largest_step_ior", curve.step_ior},
                      {"mean_error", curve.mean_error},
                      {"max_error", curve.worst_error},
                      {"unstable", curve.unstable},
                      {"clamped", curve.clamped},
                      {"least_highlight", curve.least_highlight},
                      {"jumps", curve.jumps()}});
  return {{"curves", curves},
          {"guesses",
           {{"curves", study.trials.size()},
            {"lost", losing_count(study.trials)},
            {"jumping", jumping_count(study.trials)}}},
          {"three_stages_error_gain", study.error_gain},
          {"three_stages_specular_move", study.worst_difference}};
}

}  // namespace

DielectricsStudy study_dielectrics(const Renderer& renderer, const StudyOptions& options, double diffuse) {
  DielectricsStudy study;
  study.diffuse = diffuse;
  for (const int stages : {1, 2, 3}) {
    SweepOptions sweep =
        study_sweep_options(kSource, kTarget, dielectric_samples(options), options.resolution);
    sweep.stages = stages;
    sweep.diffuse = diffuse;
    SweepExecution execution;
    execution.jobs = options.jobs;
    if (options.progress)
      execution.progress = [&](std::size_t done, std::size_t all) {
        options.progress(0.2 * (stages - 1) + 0.2 * static_cast<double>(done) / static_cast<double>(all));
      };
    study.stages.push_back(run_sweep(renderer, sweep, execution));
  }
  for (const int stages : {1, 2, 3})
    for (const double alpha : options.alphas) study.curves.push_back(curve_of(study.stages, stages, alpha));
  compare_stages(options.alphas, &study);
  study.trials = judge_guesses(try_guesses(renderer, options, diffuse), study.stages[2], options.alphas);
  return study;
}

StudyReport dielectrics_report(const DielectricsStudy& study) {
  std::vector<StudyPlot> plots;
  for (std::size_t i = 0; i < study.stages.size(); ++i)
    plots.push_back(stage_plot(study.stages[i], static_cast<int>(i + 1)));
  StudyReport report =
      study_report(dielectrics_words(study), dielectrics_json(study), "figure8_10.svg", plots);
  for (std::size_t i = 0; i < study.stages.size(); ++i)
    report.tables.emplace_back("stages" + std::to_string(i + 1) + ".csv", table_text(study.stages[i]));
  report.tables.emplace_back("guesses.csv", trials_csv(study.trials));
  report.tables.emplace_back("dielectrics.csv", materials_csv(study.stages[1]));
  return report;
}

}  // namespace remapc
