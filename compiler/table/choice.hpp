// The choice among fits of the same rows: the fewest numbers within one standard error of the best (Breiman
// et al. 1984) in cross-validation.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "table/folds.hpp"
#include "table/regression.hpp"

namespace remap {

struct Candidate {
  CandidateRecord record;  // its name, numbers and errors; the verdict is empty while it may be chosen
  Regression regression;   // of all rows; undefined if that failed
};

// Runs `work`. Returns `what: why` if it throws, else an empty text. Passes an interruption on.
std::string failure_of(const std::string& what, const std::function<void()>& work);

// Fits each candidate that may be chosen to the training rows of each fold (Regression::again), and records
// its errors on the judging rows; they are multiplied by `weight` of the value for the choice. A candidate
// that fails in a fold, or whose errors are not finite, gets a verdict. Threads as in RegressionOptions.
void cross_validate(std::span<Candidate> candidates, const std::vector<Fold>& folds,
                    double (*weight)(double value), unsigned jobs, const FitProgress& progress = {});

// Returns the index of the candidate with the fewest numbers (the first of several) whose errors of alpha and
// of specular are both within one standard error, but at least 2e-4, of the best; that is a twentieth of an
// 8-bit step. If there is none, the one whose larger error relative to that bound is least. Gives a verdict
// to all that may be chosen. Returns the number of candidates if there are none of these.
std::size_t choose(std::vector<Candidate>* candidates);

}  // namespace remap
