// `--model auto`: all regressions that apply, judged by the same rows, and the choice among them.
#pragma once

#include <vector>

#include "fit/regressors.hpp"

namespace remapc {

struct ComparisonOptions {
  RegressionOptions regression;
  std::size_t folds = 5;
  std::size_t repeats = 2;  // of the cross-validation, each with folds of its own
};

struct Contender {
  Regression regression;  // of all rows; meaningless where `fitted` is false
  remap::Candidate candidate;
  bool fitted = false;
  bool sound = false;  // fitted in every fold, and neither negative nor infinite beyond the domain
};

struct Comparison {
  std::vector<Contender> contenders;  // in the order in which they are printed
  std::size_t chosen = 0;
};

// Fits the parametric form of the paper, the parametric form that fits best, support vectors and the network
// to `rows`, and compares them:
// - by cross-validation on the rows (on 2000 of them, drawn, where there are more); forms and
//   hyper-parameters are those found on all of `rows`, coefficients are fitted anew in each fold;
// - on the outermost rows, fitted without them (edge.hpp);
// - by what they give beyond the domain (edge.hpp);
// - by whether they can be lowered with the default tolerances (lower/lower.hpp).
// One that cannot be fitted to the rows or to a fold, or that is not finite or negative beyond the domain
// without the domain rule, or whose error on the outermost rows under the domain rule is more than twice that
// of the best and 2e-3 more, loses; so does one that cannot be lowered, if another can. Among the others the
// one of fewest numbers wins whose rms errors of alpha and of specular are both within one standard error of
// the best, or within kNegligibleError (folds.hpp); where none is, the one whose worse error, as a multiple
// of that bound, is least. What loses before the folds is not fitted again in them. Throws kNumeric with the
// reasons where all lose. The result depends on nothing but
// rows, domain and options.
Comparison compare_regressions(const std::vector<TableRow>& rows, const remap::Domain& domain,
                               const ComparisonOptions& options, const FitProgress& progress = {});

// The choice among candidates, `eligible` where they take part at all; fills the verdicts of those. Given
// here for its tests. Returns candidates.size() where none is eligible.
std::size_t choose_candidate(std::vector<remap::Candidate*> candidates, const std::vector<bool>& eligible);

}  // namespace remapc
