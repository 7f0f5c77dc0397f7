// `--model auto`: fits all regressions that apply, compares them on the same rows and chooses one.
#pragma once

#include <vector>

#include "fit/regressors.hpp"

namespace remapc {

struct Contender {
  Regression regression;  // of all rows; undefined if `fitted` is false
  remap::Candidate candidate;
  bool fitted = false;
  bool sound = false;  // fitted in every fold, finite and not negative inside the domain
};

struct Comparison {
  std::vector<Contender> contenders;  // in the order in which they are printed
  std::size_t chosen = 0;
};

// Fits the parametric form of the paper, the best parametric form, series, support vectors and the network to
// `rows`. Compares them:
// - by twice five-fold cross-validation on the rows (on 2000 random rows if there are more); forms and
//   hyper-parameters are chosen on all of `rows`, coefficients are refitted in each fold;
// - on the outermost rows, after fitting without them (edge.hpp);
// - by their values inside the domain (edge.hpp);
// - by whether they can be lowered with the default tolerances (lower/lower.hpp).
//
// A contender is rejected if it cannot be fitted to the rows or to a fold, if it is not finite or negative
// inside the domain, or if its error on the outermost rows under the domain rule exceeds both twice the best
// error and the best error plus 2e-3. A contender that cannot be lowered is rejected if another can. Of the
// others, the one with the fewest numbers is chosen whose relative errors of alpha and specular are both
// within one standard error of the best or within kNegligibleError (folds.hpp). If
// there is none, the one is chosen whose larger error relative to that bound is least. Contenders that are
// rejected before the folds are not refitted. Throws kNumeric with the reasons if all are rejected. The
// result depends only on rows, domain and options.
Comparison compare_regressions(const std::vector<TableRow>& rows, const remap::Domain& domain,
                               const RegressionOptions& options, const FitProgress& progress = {});

// Chooses among the candidates that are `eligible` and fills their verdicts. Returns candidates.size() if
// none is eligible. Public for the tests.
std::size_t choose_candidate(std::vector<remap::Candidate*> candidates, const std::vector<bool>& eligible);

}  // namespace remapc
