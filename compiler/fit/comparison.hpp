// Compares fits of one table, and chooses the one with the fewest numbers that pictures cannot tell from
// more.
#pragma once

#include <vector>

#include "lights/pair_pictures.hpp"
#include "table/regression.hpp"
#include "table/split.hpp"

namespace remap {

struct Candidate {
  CandidateRecord record;  // the verdict is empty while it may be chosen
  Fit fit;                 // with errors on the held-out rows; undefined if it failed
};

struct Comparison {
  std::vector<Candidate> candidates;  // in the order in which they are printed
  std::size_t chosen = 0;
};

// Fits compact forms of all shapes (lower/form_fit.hpp) to the training rows of `split`. `base`: the fit but
// for its mapping. Forms of pairs that `pictures` knows are then refined by pictures; null: rows are all
// there is.
//
// Of the candidates that are sound, the one with the fewest numbers is chosen whose judged errors are near
// the best: with pictures both within 1 % (of the RMSE also within .05 points, an eighth of an 8-bit step),
// else both relative errors on the held-out rows within .01, which pictures do not show, or within 1 %.
// Throws kNumeric with the reasons if none is sound.
Comparison compare_forms(const Fit& base, const RowSplit& split, const PairPictures* pictures,
                         const FitProgress& progress);

// Sets the errors on the held-out rows and, where there are pictures, those.
void judge_fit(const RowSplit& split, const PairPictures* pictures, Fit* fit);

}  // namespace remap
