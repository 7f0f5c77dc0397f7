#include "fit/comparison.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "fit/edge.hpp"
#include "lower/lower.hpp"

namespace remap {
namespace {

constexpr std::size_t kMostRows = 2000;
constexpr std::size_t kFolds = 5;
constexpr std::size_t kRepeats = 2;  // of the cross-validation, each with different folds
constexpr double kEdgeFactor = 2.0;
constexpr double kEdgeMargin = 2e-3;
// The share of the progress for the fits with their searches; the rest is for the folds.
constexpr double kShareOfFits = 0.5;

bool may_be_chosen(const Candidate& candidate) { return candidate.record.verdict.empty(); }

class ComparisonRun {
 public:
  ComparisonRun(const std::vector<TableRow>& rows, const Domain& domain, const RegressionOptions& options,
                const FitProgress& progress)
      : rows_(rows), domain_(domain), options_(options), progress_(progress) {}

  Comparison compare() {
    enter_all();
    for (Candidate& candidate : candidates_) judge_beyond(candidate);
    judge_by_lowering();
    judge_by_folds();
    judge_by_edge();
    return decide();
  }

 private:
  void enter_all() {
    const bool has_paper = options_.form.empty();
    if (has_paper) {
      RegressionOptions paper = options_;
      paper.form = "paper";
      enter("paper", kFitKinds.front(), paper);
    }
    for (const FitKind& kind : kFitKinds) enter(std::string(kind.name), kind, options_);
    const auto is_paper = [](const Candidate& candidate) {
      const auto form = candidate.regression.method.find("form");
      return form != candidate.regression.method.end() && form->second == "paper";
    };
    // If both are the same, the one that records how it was chosen stays.
    if (has_paper && is_paper(candidates_[0]) && is_paper(candidates_[1]))
      candidates_.erase(candidates_.begin());
  }

  void enter(const std::string& name, const FitKind& kind, const RegressionOptions& options) {
    constexpr double kAll = 1.0 + static_cast<double>(kFitKinds.size());
    const auto entered = static_cast<double>(candidates_.size());
    Candidate& candidate = candidates_.emplace_back();
    candidate.record.name = name;
    candidate.record.verdict = failure_of("not fitted", [&] {
      candidate.regression =
          kind.fit(rows_, domain_, options,
                   part_of(progress_, kShareOfFits * entered / kAll, kShareOfFits * (entered + 1.0) / kAll));
      candidate.record.number_count = number_count(candidate.regression.mapping);
      if (const auto form = candidate.regression.method.find("form");
          form != candidate.regression.method.end())
        candidate.record.name = std::string(kind.name) + " " + form->second;
    });
  }

  void judge_beyond(Candidate& candidate) {
    if (!may_be_chosen(candidate)) return;
    const BeyondDomain beyond = look_beyond(candidate.regression.mapping, domain_);
    candidate.record.chroma_shift = beyond.chroma_shift;
    if (!beyond.fault.empty()) candidate.record.verdict = "breaks inside the domain: " + beyond.fault;
  }

  // Rejects candidates that `remapc emit` would refuse, if another one can be emitted.
  void judge_by_lowering() {
    std::vector<std::string> refusals(candidates_.size());
    run_parallel(candidates_.size(), options_.jobs, [&](std::size_t i) {
      if (may_be_chosen(candidates_[i]))
        refusals[i] =
            failure_of("cannot be emitted", [&] { lower(candidates_[i].regression.mapping, domain_); });
    });
    bool any = false;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      any |= may_be_chosen(candidates_[i]) && refusals[i].empty();
    for (std::size_t i = 0; any && i < candidates_.size(); ++i)
      if (may_be_chosen(candidates_[i])) candidates_[i].record.verdict = refusals[i];
  }

  void judge_by_folds() {
    const std::vector<TableRow> drawn = draw_rows(rows_, kMostRows, options_.seed);
    std::vector<Fold> folds;
    for (std::size_t repeat = 0; repeat < kRepeats; ++repeat) {
      // The seeds are far apart, so that seed and seed + 1 share no folds.
      for (Fold& fold : split_folds(drawn, kFolds, options_.seed + 1000003 * (repeat + 1)))
        folds.push_back(std::move(fold));
    }
    cross_validate(&candidates_, folds, error_weight, options_.jobs, part_of(progress_, kShareOfFits, 1.0));
  }

  void judge_by_edge() {
    const EdgeRows edge = edge_rows(draw_rows(rows_, kMostRows, options_.seed));
    if (edge.outer.empty()) return;
    run_parallel(candidates_.size(), options_.jobs, [&](std::size_t task) {
      Candidate& candidate = candidates_[candidates_.size() - 1 - task];
      if (!may_be_chosen(candidate)) return;
      candidate.record.verdict = failure_of("not fitted without the outermost rows", [&] {
        const MappingKind mapping = candidate.regression.again(edge.inner);
        const EdgeErrors errors = edge_errors(mapping, covered_domain(edge.inner), edge.outer);
        candidate.record.edge_alpha_rms = errors.alpha_rms;
        candidate.record.edge_specular_rms = errors.specular_rms;
        candidate.record.raw_edge_alpha_rms = errors.raw_alpha_rms;
        candidate.record.raw_edge_specular_rms = errors.raw_specular_rms;
      });
    });
    refuse_bad_edges();
  }

  void refuse_bad_edges() {
    double best_alpha = 1e300, best_specular = 1e300;
    for (const Candidate& candidate : candidates_) {
      if (!may_be_chosen(candidate)) continue;
      best_alpha = std::min(best_alpha, candidate.record.edge_alpha_rms);
      best_specular = std::min(best_specular, candidate.record.edge_specular_rms);
    }
    const auto bound = [](double best) { return std::max(kEdgeFactor * best, best + kEdgeMargin); };
    for (Candidate& candidate : candidates_)
      if (may_be_chosen(candidate) && !(candidate.record.edge_alpha_rms <= bound(best_alpha) &&
                                        candidate.record.edge_specular_rms <= bound(best_specular)))
        candidate.record.verdict = "worse at the edge";
  }

  Comparison decide() {
    const std::size_t chosen = choose(&candidates_);
    if (chosen == candidates_.size()) {
      std::string reasons;
      for (const auto& [record, regression] : candidates_)
        reasons += "; " + record.name + ": " + record.verdict;
      throw numeric_error("fit: no regression fits the table" + reasons);
    }
    candidates_[chosen].regression.method["chosen by"] =
        std::to_string(kRepeats) + " x " + std::to_string(kFolds) + "-fold cross-validation on " +
        std::to_string(std::min(rows_.size(), kMostRows)) + " training rows, seed " +
        std::to_string(options_.seed);
    return {std::move(candidates_), chosen};
  }

  const std::vector<TableRow>& rows_;
  const Domain& domain_;
  const RegressionOptions& options_;
  const FitProgress& progress_;
  std::vector<Candidate> candidates_;
};

}  // namespace

Comparison compare_regressions(const std::vector<TableRow>& rows, const Domain& domain,
                               const RegressionOptions& options, const FitProgress& progress) {
  return ComparisonRun(rows, domain, options, progress).compare();
}

}  // namespace remap
