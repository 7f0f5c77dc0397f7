// This file fits a table. It splits the rows, fits them by one of the kinds, computes errors on the held-out
// rows, and records how the fit was made. Each kind has a folder with its regression, and one line in
// fit_kind(). It also makes the table of the inverse of a fit, which can be fitted like any other table.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fit/network/fit_network.hpp"
#include "lights/pair_pictures.hpp"
#include "lower/fit.hpp"
#include "table/regression.hpp"
#include "table/table.hpp"

namespace remap {

struct FitOptions {
  std::string id;          // if empty, `<source>_to_<target>` from the table
  std::string_view kind;   // one of kFitKinds; if empty, compare_forms() chooses
  std::uint64_t seed = 1;  // seed of the split and of the regression
  unsigned jobs = 0;       // threads; 0: one per core. Results do not depend on it
  std::string form;        // form of the parametric kind; if empty, the paper's
  TrainingOptions mlp;     // its seed and jobs are replaced by those above
  double held_out_fraction = 0.2;
  bool accept_light = false;  // see is_wrong_light() (table/table.hpp)
};

// These are the regressions that a user can choose. If the user chooses none, forms are compared
// (comparison.cpp).
inline constexpr std::array<std::string_view, 3> kFitKinds = {"parametric", "svr", "mlp"};

// Fits the rows below the limits of the target by the kind of the options. The curves must be sound in
// `domain`. Throws kUsage for a kind that is not in the list, and the errors of the regression.
Regression fit_kind(const std::vector<TableRow>& rows, const Domain& domain, const FitOptions& options,
                    const FitProgress& progress = {});

// Fits `table`. `bytes` is its file, whose SHA-256 the fit records. Throws kInput if the table does not name
// its models or cannot be fitted (require_fittable), kUsage for an invalid id, and the errors of the
// regression. The result does not depend on the number of jobs. If forms are compared, `compared` receives
// their fits (compare_forms).
Fit fit_table(const Table& table, std::string_view bytes, const FitOptions& options,
              const FitProgress& progress = {}, std::vector<Fit>* compared = nullptr);

// Samples the target parameters of `fit` and finds the source parameters that `fit` converts to them
// (lower/chain.hpp). The target of `fit` becomes the source of the table. 48 alphas cover the
// range that `fit` reaches at its least specular sample. Ten speculars go up to the largest that
// `fit` reaches at every alpha. If no source parameters in the domain give a row's target, the row is
// clamped. It is flat if even specular 0 gives more. `bytes` is the fit file, whose SHA-256 is recorded.
// Errors are NaN, because no pictures are compared.
Table inverse_table(const Fit& fit, std::string_view bytes);

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
