// `--model auto`: fits all regressions that apply, compares them on the same rows and chooses one.
#pragma once

#include <vector>

#include "fit/kinds.hpp"
#include "table/choice.hpp"

namespace remap {

struct Comparison {
  std::vector<Candidate> candidates;  // in the order in which they are printed
  std::size_t chosen = 0;
};

// Fits the parametric form of the paper and the kinds of the list (kinds.hpp) to `rows`. The slower half of
// the list is fitted only if none of the faster half may be chosen with relative errors of at most 1e-3 in
// both outputs. Compares them:
// - by twice five-fold cross-validation on the rows (on 2000 random rows if there are more); forms and
//   hyper-parameters are chosen on all of `rows`, coefficients are refitted in each fold;
// - on the outermost rows, after fitting without them (edge.hpp);
// - by their values inside the domain (edge.hpp);
// - by whether they can be lowered with the default tolerances (lower/lower.hpp).
//
// A candidate is rejected if it cannot be fitted to the rows or to a fold, if it is not finite or negative
// inside the domain, or if its error on the outermost rows under the domain rule exceeds both twice the best
// error and the best error plus 2e-3. A candidate that cannot be lowered is rejected if another can. Among
// the others, choose() (choice.hpp) decides by relative errors. Candidates that are rejected before the folds
// are not refitted. Throws kNumeric with the reasons if all are rejected. The result depends only on rows,
// domain and options.
Comparison compare_regressions(const std::vector<TableRow>& rows, const Domain& domain,
                               const RegressionOptions& options, const FitProgress& progress = {});

}  // namespace remap
