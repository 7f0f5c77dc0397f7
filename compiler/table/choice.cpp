#include "table/choice.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "core/parallel.hpp"
#include "remap/error.hpp"
#include "table/split.hpp"

namespace remap {
namespace {

constexpr double kNegligibleError = 2e-4;

// What one candidate gives in one fold.
struct FoldErrors {
  Residuals residuals, weighted;
  std::string failure;
};

FoldErrors errors_in(const Fold& fold, const Candidate& candidate, double (*weight)(double)) {
  FoldErrors errors;
  if (!candidate.record.verdict.empty() || fold.judging.empty()) return errors;
  errors.failure = failure_of("not fitted in a fold", [&] {
    errors.residuals = residuals_of(fold.judging, candidate.regression.again(fold.training));
    for (std::size_t i = 0; i < fold.judging.size(); ++i) {
      const TableRow& row = fold.judging[i];
      errors.weighted.alpha.push_back(errors.residuals.alpha[i] * weight(row.alpha2));
      errors.weighted.specular.push_back(errors.residuals.specular[i] * weight(row.specular2));
    }
  });
  return errors;
}

// The RMS error over all rows, and its standard error over the folds.
RelativeError score_of(const std::vector<FoldErrors>& folds, std::vector<double> Residuals::*output) {
  double total = 0.0, count = 0.0;
  std::vector<double> figures;  // root mean square of each fold
  for (const FoldErrors& fold : folds) {
    const std::vector<double>& errors = fold.weighted.*output;
    if (errors.empty()) continue;
    const double square = std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0);
    const auto size = static_cast<double>(errors.size());
    total += square;
    count += size;
    figures.push_back(std::sqrt(square / size));
  }
  if (figures.empty()) return {};
  const auto size = static_cast<double>(figures.size());
  const double mean = std::accumulate(figures.begin(), figures.end(), 0.0) / size;
  double variance = 0.0;
  for (const double figure : figures) variance += (figure - mean) * (figure - mean);
  const double error = size < 2.0 ? 0.0 : std::sqrt(variance / (size - 1.0) / size);
  return {std::sqrt(total / count), error};
}

ErrorFigures figures_of(const std::vector<FoldErrors>& folds, std::vector<double> Residuals::*output) {
  std::vector<double> all;
  for (const FoldErrors& fold : folds)
    all.insert(all.end(), (fold.residuals.*output).begin(), (fold.residuals.*output).end());
  return error_figures(std::move(all));
}

void put_together(const std::vector<FoldErrors>& folds, CandidateRecord* record) {
  for (const FoldErrors& fold : folds)
    if (record->verdict.empty()) record->verdict = fold.failure;
  record->alpha = figures_of(folds, &Residuals::alpha);
  record->specular = figures_of(folds, &Residuals::specular);
  record->relative_alpha = score_of(folds, &Residuals::alpha);
  record->relative_specular = score_of(folds, &Residuals::specular);
  const bool finite =
      std::isfinite(record->relative_alpha.rms) && std::isfinite(record->relative_specular.rms);
  if (record->verdict.empty() && !finite) record->verdict = "errors are not finite";
}

// The error up to which a fit counts as equal to the best.
double error_bound(const std::vector<Candidate>& candidates, RelativeError CandidateRecord::*output) {
  double best = 1e300, bound = 1e300;
  for (const Candidate& candidate : candidates) {
    const RelativeError& error = candidate.record.*output;
    if (!candidate.record.verdict.empty() || !(error.rms < best)) continue;
    best = error.rms;
    bound = best + std::max(error.standard_error, kNegligibleError);
  }
  return bound;
}

}  // namespace

std::string failure_of(const std::string& what, const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    return what + ": " + error.what();
  }
}

void cross_validate(std::span<Candidate> candidates, const std::vector<Fold>& folds, double (*weight)(double),
                    unsigned jobs, const FitProgress& progress) {
  std::vector<std::vector<FoldErrors>> errors(candidates.size(), std::vector<FoldErrors>(folds.size()));
  const std::size_t count = candidates.size() * folds.size();
  std::mutex mutex;
  std::size_t done = 0;
  run_parallel(count, jobs, [&](std::size_t task) {
    // The last candidates are the slowest, so they start first.
    const std::size_t c = candidates.size() - 1 - task / folds.size(), f = task % folds.size();
    errors[c][f] = errors_in(folds[f], candidates[c], weight);
    const std::lock_guard lock(mutex);
    if (progress) progress(static_cast<double>(++done) / static_cast<double>(count));
  });
  for (std::size_t c = 0; c < candidates.size(); ++c) put_together(errors[c], &candidates[c].record);
}

std::size_t choose(std::vector<Candidate>* candidates) {
  const double alpha_bound = error_bound(*candidates, &CandidateRecord::relative_alpha),
               specular_bound = error_bound(*candidates, &CandidateRecord::relative_specular);
  const Candidate* chosen = nullptr;
  double least_excess = 1e300;
  for (Candidate& candidate : *candidates) {
    CandidateRecord& record = candidate.record;
    if (!record.verdict.empty()) continue;
    // 1 for all that count as equal to the best; the number of constants decides among them.
    const double excess = std::max(
        {1.0, record.relative_alpha.rms / alpha_bound, record.relative_specular.rms / specular_bound});
    if (excess < least_excess ||
        (excess == least_excess && record.number_count < chosen->record.number_count)) {
      chosen = &candidate;
      least_excess = excess;
    }
    record.verdict = record.relative_alpha.rms > alpha_bound
                         ? "alpha error beyond one standard error of the best"
                     : record.relative_specular.rms > specular_bound
                         ? "specular error beyond one standard error of the best"
                         : "no better, and more numbers";
  }
  if (chosen == nullptr) return candidates->size();
  const auto index = static_cast<std::size_t>(chosen - candidates->data());
  (*candidates)[index].record.verdict = "chosen";
  return index;
}

}  // namespace remap
