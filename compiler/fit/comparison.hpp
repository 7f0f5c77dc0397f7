// This file compares fits of one table. It chooses the fit with the fewest numbers among those that look like
// the best.
#pragma once

#include <vector>

#include "lights/pair_pictures.hpp"
#include "table/regression.hpp"

namespace remap {

// Fits compact forms of all shapes (lower/form_fit.hpp) to the training rows of `split`. `base` is the fit
// without its mapping. If `pictures` is not null and has the pair of models, pictures then refine the forms.
// Otherwise, only rows are used.
//
// Among the sound candidates whose errors are close to the best, chooses the one with the fewest numbers.
// With pictures, both errors must be within 1 % of the best (or the RMSE within .05 points, which is an
// eighth of an 8-bit step). Without pictures, both relative errors on the held-out rows must be within 1 %,
// or within .01, which pictures do not show. Throws kNumeric with the reasons if no candidate is sound.
//
// If `compared` is not null, it receives the fits that were compared, for plots, in the order of the
// candidates.
Fit compare_forms(const Fit& base, const RowSplit& split, const PairPictures* pictures,
                  const FitProgress& progress, std::vector<Fit>* compared = nullptr);

// Sets the errors on the held-out rows and, if there are pictures, the errors of pictures.
void judge_fit(const RowSplit& split, const PairPictures* pictures, Fit* fit);

}  // namespace remap
