#include "fit/comparison.hpp"

#include <algorithm>
#include <span>

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
// The kinds are fitted in two stages. A quarter of an 8-bit step: nearer ones make no other picture.
constexpr std::size_t kStages = 2;
constexpr double kSufficientError = 1e-3;
// The share of a stage's progress for the fits with their searches; the rest is for the folds.
constexpr double kShareOfFits = 0.5;

bool may_be_chosen(const Candidate& candidate) { return candidate.record.verdict.empty(); }

class ComparisonRun {
 public:
  ComparisonRun(const std::vector<TableRow>& rows, const Domain& domain, const RegressionOptions& options,
                const FitProgress& progress)
      : rows_(rows), domain_(domain), options_(options), progress_(progress) {}

  Comparison compare() {
    if (options_.form.empty()) {
      RegressionOptions paper = options_;
      paper.form = "paper";
      enter("paper", kFitKinds.front(), paper, {});
    }
    for (std::size_t stage = 0; stage < kStages && !is_sufficient(); ++stage) run_stage(stage);
    if (progress_) progress_(1.0);
    return decide();
  }

 private:
  void run_stage(std::size_t stage) {
    constexpr std::size_t kKinds = kFitKinds.size() / kStages;
    static_assert(kKinds * kStages == kFitKinds.size());
    const auto share = [&](double part) { return (static_cast<double>(stage) + part) / kStages; };
    for (std::size_t k = 0; k < kKinds; ++k) {
      const FitKind& kind = kFitKinds[stage * kKinds + k];
      const auto at = [&](std::size_t i) { return share(kShareOfFits * static_cast<double>(i) / kKinds); };
      enter(std::string(kind.name), kind, options_, part_of(progress_, at(k), at(k + 1)));
    }
    if (stage == 0) drop_repeated_paper();
    const std::span<Candidate> added = std::span(candidates_).subspan(judged_);
    for (Candidate& candidate : added) judge_beyond(candidate);
    judge_by_lowering(added);
    judge_by_folds(added, part_of(progress_, share(kShareOfFits), share(1.0)));
    judge_by_edge(added);
    judged_ = candidates_.size();
  }

  // If the form of the paper was chosen, too, the one that records how it was chosen stays.
  void drop_repeated_paper() {
    const auto is_paper = [](const Candidate& candidate) {
      const auto form = candidate.regression.method.find("form");
      return form != candidate.regression.method.end() && form->second == "paper";
    };
    if (options_.form.empty() && is_paper(candidates_[0]) && is_paper(candidates_[1]))
      candidates_.erase(candidates_.begin());
  }

  void enter(const std::string& name, const FitKind& kind, const RegressionOptions& options,
             const FitProgress& progress) {
    Candidate& candidate = candidates_.emplace_back();
    candidate.record.name = name;
    candidate.record.verdict = failure_of("not fitted", [&] {
      candidate.regression = kind.fit(rows_, domain_, options, progress);
      candidate.record.number_count = number_count(candidate.regression.mapping);
      if (const auto form = candidate.regression.method.find("form");
          form != candidate.regression.method.end())
        candidate.record.name = std::string(kind.name) + " " + form->second;
    });
  }

  // Whether a candidate that may be chosen is so near that slower kinds need not be fitted.
  bool is_sufficient() const {
    for (std::size_t i = 0; i < judged_; ++i) {
      const CandidateRecord& record = candidates_[i].record;
      if (may_be_chosen(candidates_[i]) && refusals_[i].empty() &&
          std::max(record.relative_alpha.rms, record.relative_specular.rms) <= kSufficientError)
        return true;
    }
    return false;
  }

  void judge_beyond(Candidate& candidate) {
    if (!may_be_chosen(candidate)) return;
    const BeyondDomain beyond = look_beyond(candidate.regression.mapping, domain_);
    candidate.record.chroma_shift = beyond.chroma_shift;
    if (!beyond.fault.empty()) candidate.record.verdict = "breaks inside the domain: " + beyond.fault;
  }

  // Rejects candidates that `remapc emit` would refuse, if another one can be emitted.
  void judge_by_lowering(std::span<Candidate> added) {
    refusals_.resize(candidates_.size());
    run_parallel(added.size(), options_.jobs, [&](std::size_t i) {
      if (may_be_chosen(added[i]))
        refusals_[judged_ + i] =
            failure_of("cannot be emitted", [&] { lower(added[i].regression.mapping, domain_); });
    });
    bool any = false;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      any |= may_be_chosen(candidates_[i]) && refusals_[i].empty();
    for (std::size_t i = 0; any && i < candidates_.size(); ++i)
      if (may_be_chosen(candidates_[i])) candidates_[i].record.verdict = refusals_[i];
  }

  void judge_by_folds(std::span<Candidate> added, const FitProgress& progress) {
    const std::vector<TableRow> drawn = draw_rows(rows_, kMostRows, options_.seed);
    std::vector<Fold> folds;
    for (std::size_t repeat = 0; repeat < kRepeats; ++repeat) {
      // The seeds are far apart, so that seed and seed + 1 share no folds.
      for (Fold& fold : split_folds(drawn, kFolds, options_.seed + 1000003 * (repeat + 1)))
        folds.push_back(std::move(fold));
    }
    cross_validate(added, folds, error_weight, options_.jobs, progress);
  }

  void judge_by_edge(std::span<Candidate> added) {
    const EdgeRows edge = edge_rows(draw_rows(rows_, kMostRows, options_.seed));
    if (edge.outer.empty()) return;
    run_parallel(added.size(), options_.jobs, [&](std::size_t task) {
      Candidate& candidate = added[added.size() - 1 - task];
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
  std::vector<std::string> refusals_;  // of `remapc emit`, by candidate; empty: none
  std::size_t judged_ = 0;             // candidates
};

}  // namespace

Comparison compare_regressions(const std::vector<TableRow>& rows, const Domain& domain,
                               const RegressionOptions& options, const FitProgress& progress) {
  return ComparisonRun(rows, domain, options, progress).compare();
}

}  // namespace remap
