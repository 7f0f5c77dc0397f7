#include "fit/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "fit/edge.hpp"
#include "fit/rows/folds.hpp"
#include "fit/rows/split.hpp"
#include "lower/lower.hpp"
#include "system/parallel.hpp"
#include "text/errors.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::Candidate;
using remap::Error;
using remap::ErrorKind;

constexpr std::size_t kMostRows = 2000;
constexpr std::size_t kFolds = 5;
constexpr std::size_t kRepeats = 2;  // of the cross-validation, each with different folds
constexpr double kEdgeFactor = 2.0;
constexpr double kEdgeMargin = 2e-3;
// The share of the progress for the fits with their searches; the rest is for the folds.
constexpr double kShareOfFits = 0.5;

// The errors of one contender on the held-out rows of a fold.
struct FoldErrors {
  Residuals residuals, relative;
  std::string failure;
};

void reject(Contender& contender, const std::string& verdict) {
  contender.sound = false;
  contender.candidate.verdict = verdict;
}

// Runs `work`. Returns `what: why` if it throws, else an empty text. An interruption ends the comparison.
std::string failure_of(const std::string& what, const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    return what + ": " + error.what();
  }
}

class ComparisonRun {
 public:
  ComparisonRun(const std::vector<TableRow>& rows, const remap::Domain& domain,
                const RegressionOptions& options, const FitProgress& progress)
      : rows_(rows), domain_(domain), options_(options), progress_(progress) {}

  Comparison compare() {
    enter_all();
    for (Contender& contender : comparison_.contenders) judge_beyond(contender);
    judge_by_lowering();
    judge_by_folds();
    judge_by_edge();
    decide();
    return std::move(comparison_);
  }

 private:
  void enter_all() {
    RegressionOptions regression = options_;
    if (regression.form.empty()) {
      regression.form = "paper";
      enter("paper", Regressor::kParametric, regression);
      regression.form.clear();
    }
    enter("parametric", Regressor::kParametric, regression);
    std::vector<Contender>& contenders = comparison_.contenders;
    if (contenders.size() == 2 && contenders[0].fitted && contenders[1].fitted &&
        contenders[1].regression.method.at("form") == "paper")
      contenders.erase(contenders.begin());  // both are the same; the other one records how it was chosen
    enter("series", Regressor::kSeries, regression);
    enter("svr", Regressor::kSvr, regression);
    enter("mlp", Regressor::kMlp, regression);
  }

  void enter(const std::string& name, Regressor regressor, const RegressionOptions& regression) {
    Contender contender;
    contender.candidate.name = name;
    contender.candidate.verdict = failure_of("not fitted", [&] {
      contender.regression = regress(regressor, rows_, domain_, regression, [&](double share) {
        report(kShareOfFits * (static_cast<double>(entered_) + share) / kContenders);
      });
      contender.fitted = contender.sound = true;
      contender.candidate.number_count = remap::number_count(contender.regression.mapping);
      if (regressor == Regressor::kParametric)
        contender.candidate.name = "parametric " + contender.regression.method.at("form");
    });
    ++entered_;
    comparison_.contenders.push_back(std::move(contender));
  }

  // Runs all folds of all contenders, each as one task.
  void judge_by_folds() {
    const std::vector<TableRow> drawn = draw_rows(rows_, kMostRows, options_.seed);
    std::vector<Fold> folds;
    for (std::size_t repeat = 0; repeat < kRepeats; ++repeat) {
      // The seeds are far apart, so that seed and seed + 1 share no folds.
      for (Fold& fold : split_folds(drawn, kFolds, options_.seed + 1000003 * (repeat + 1)))
        folds.push_back(std::move(fold));
    }
    std::vector<Contender>& contenders = comparison_.contenders;
    std::vector<std::vector<FoldErrors>> errors(contenders.size(), std::vector<FoldErrors>(folds.size()));
    const std::size_t count = contenders.size() * folds.size();
    remap::run_parallel(count, options_.jobs, [&](std::size_t task) {
      // The last contenders are the slowest, so they start first.
      const std::size_t c = contenders.size() - 1 - task / folds.size(), f = task % folds.size();
      errors[c][f] = errors_in_fold(contenders[c], folds[f]);
      const std::lock_guard lock(mutex_);
      ++judged_;
      report(kShareOfFits + (1.0 - kShareOfFits) * static_cast<double>(judged_) / static_cast<double>(count));
    });
    for (std::size_t c = 0; c < contenders.size(); ++c) put_together(contenders[c], errors[c]);
  }

  FoldErrors errors_in_fold(const Contender& contender, const Fold& fold) const {
    FoldErrors errors;
    if (!contender.sound || fold.judging.empty()) return errors;
    errors.failure = failure_of("not fitted in a fold", [&] {
      errors.residuals =
          residuals_of(fold.judging, regress_again(contender.regression, fold.training, single_threaded()));
      for (std::size_t i = 0; i < fold.judging.size(); ++i) {
        const TableRow& row = fold.judging[i];
        errors.relative.alpha.push_back(errors.residuals.alpha[i] * error_weight(row.alpha2));
        errors.relative.specular.push_back(errors.residuals.specular[i] * error_weight(row.specular2));
      }
    });
    return errors;
  }

  static void put_together(Contender& contender, const std::vector<FoldErrors>& folds) {
    for (const FoldErrors& fold : folds)
      if (!fold.failure.empty() && contender.sound) reject(contender, fold.failure);
    const auto join = [&](std::vector<double> Residuals::*output, remap::ErrorFigures* figures,
                          remap::RelativeError* relative) {
      std::vector<double> all;
      std::vector<std::vector<double>> by_fold;
      for (const FoldErrors& fold : folds) {
        const std::vector<double>& own = fold.residuals.*output;
        all.insert(all.end(), own.begin(), own.end());
        by_fold.push_back(fold.relative.*output);
      }
      *figures = error_figures(std::move(all));
      const CrossValidated score = cross_validated(by_fold);
      *relative = {score.rms, score.standard_error};
    };
    Candidate& candidate = contender.candidate;
    join(&Residuals::alpha, &candidate.alpha, &candidate.relative_alpha);
    join(&Residuals::specular, &candidate.specular, &candidate.relative_specular);
  }

  void judge_beyond(Contender& contender) {
    if (!contender.fitted) return;
    const BeyondDomain beyond = look_beyond(contender.regression.mapping, domain_);
    contender.candidate.chroma_shift = beyond.chroma_shift;
    if (!beyond.fault.empty()) reject(contender, "breaks inside the domain: " + beyond.fault);
  }

  void judge_by_edge() {
    const EdgeRows edge = edge_rows(draw_rows(rows_, kMostRows, options_.seed));
    if (edge.outer.empty()) return;
    std::vector<Contender>& contenders = comparison_.contenders;
    remap::run_parallel(contenders.size(), options_.jobs, [&](std::size_t task) {
      Contender& contender = contenders[contenders.size() - 1 - task];
      if (!contender.sound) return;
      const std::string failure = failure_of("not fitted without the outermost rows", [&] {
        const remap::MappingKind mapping = regress_again(contender.regression, edge.inner, single_threaded());
        const EdgeErrors errors = edge_errors(mapping, covered_domain(edge.inner), edge.outer);
        contender.candidate.edge_alpha_rms = errors.alpha_rms;
        contender.candidate.edge_specular_rms = errors.specular_rms;
        contender.candidate.raw_edge_alpha_rms = errors.raw_alpha_rms;
        contender.candidate.raw_edge_specular_rms = errors.raw_specular_rms;
      });
      if (!failure.empty()) reject(contender, failure);
    });
    refuse_bad_edges();
  }

  void refuse_bad_edges() {
    double best_alpha = 1e300, best_specular = 1e300;
    for (const Contender& contender : comparison_.contenders) {
      if (!contender.sound) continue;
      best_alpha = std::min(best_alpha, contender.candidate.edge_alpha_rms);
      best_specular = std::min(best_specular, contender.candidate.edge_specular_rms);
    }
    const auto bound = [](double best) { return std::max(kEdgeFactor * best, best + kEdgeMargin); };
    for (Contender& contender : comparison_.contenders)
      if (contender.sound && !(contender.candidate.edge_alpha_rms <= bound(best_alpha) &&
                               contender.candidate.edge_specular_rms <= bound(best_specular)))
        reject(contender, "worse at the edge");
  }

  // Rejects contenders that `remapc emit` would refuse, if another one can be emitted.
  void judge_by_lowering() {
    std::vector<Contender>& contenders = comparison_.contenders;
    std::vector<std::string> refusals(contenders.size());
    remap::run_parallel(contenders.size(), options_.jobs, [&](std::size_t i) {
      if (contenders[i].sound)
        refusals[i] =
            failure_of("cannot be emitted", [&] { remap::lower(contenders[i].regression.mapping, domain_); });
    });
    bool any = false;
    for (std::size_t i = 0; i < contenders.size(); ++i) any |= contenders[i].sound && refusals[i].empty();
    for (std::size_t i = 0; any && i < contenders.size(); ++i)
      if (contenders[i].sound && !refusals[i].empty()) reject(contenders[i], refusals[i]);
  }

  void decide() {
    std::vector<Candidate*> candidates;
    std::vector<bool> eligible;
    std::string reasons;
    for (Contender& contender : comparison_.contenders) {
      candidates.push_back(&contender.candidate);
      eligible.push_back(contender.sound);
      reasons += "; " + contender.candidate.name + ": " + contender.candidate.verdict;
    }
    comparison_.chosen = choose_candidate(candidates, eligible);
    if (comparison_.chosen == candidates.size())
      throw numeric_error("fit: no regression fits the table" + reasons);
    comparison_.contenders[comparison_.chosen].regression.method["chosen by"] =
        std::to_string(kRepeats) + " x " + std::to_string(kFolds) + "-fold cross-validation on " +
        std::to_string(std::min(rows_.size(), kMostRows)) + " training rows, seed " +
        std::to_string(options_.seed);
  }

  RegressionOptions single_threaded() const {
    RegressionOptions options = options_;
    options.jobs = 1;
    return options;
  }

  void report(double share) const {
    if (progress_) progress_(share);
  }

  static constexpr double kContenders = 5.0;

  const std::vector<TableRow>& rows_;
  const remap::Domain& domain_;
  const RegressionOptions& options_;
  const FitProgress& progress_;
  Comparison comparison_;
  std::size_t entered_ = 0;
  std::mutex mutex_;
  std::size_t judged_ = 0;
};

}  // namespace

std::size_t choose_candidate(std::vector<Candidate*> candidates, const std::vector<bool>& eligible) {
  const auto bound_of = [&](remap::RelativeError Candidate::*output) {
    std::vector<CrossValidated> scores;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (eligible[i])
        scores.push_back({(candidates[i]->*output).rms, (candidates[i]->*output).standard_error});
    return error_bound(scores);
  };
  const double alpha_bound = bound_of(&Candidate::relative_alpha),
               specular_bound = bound_of(&Candidate::relative_specular);
  std::size_t chosen = candidates.size();
  double least_excess = 1e300;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!eligible[i]) continue;
    // 1 for all candidates that count as equal to the best; the number of constants decides among them.
    const double excess = std::max({1.0, candidates[i]->relative_alpha.rms / alpha_bound,
                                    candidates[i]->relative_specular.rms / specular_bound});
    if (excess < least_excess ||
        (excess == least_excess && candidates[i]->number_count < candidates[chosen]->number_count)) {
      chosen = i;
      least_excess = excess;
    }
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!eligible[i]) continue;
    Candidate& candidate = *candidates[i];
    if (i == chosen)
      candidate.verdict = "chosen";
    else if (candidate.relative_alpha.rms > alpha_bound)
      candidate.verdict = "alpha error beyond one standard error of the best";
    else if (candidate.relative_specular.rms > specular_bound)
      candidate.verdict = "specular error beyond one standard error of the best";
    else
      candidate.verdict = "no better, and more numbers";
  }
  return chosen;
}

Comparison compare_regressions(const std::vector<TableRow>& rows, const remap::Domain& domain,
                               const RegressionOptions& options, const FitProgress& progress) {
  return ComparisonRun(rows, domain, options, progress).compare();
}

}  // namespace remapc
