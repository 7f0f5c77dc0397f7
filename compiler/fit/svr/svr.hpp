// Support vector regression (Sztrajman et al. 2019, section 5.1) with libsvm: epsilon-SVR, radial basis
// functions, one model an output.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fit/rows/regression.hpp"
#include "fit/svr/svr_options.hpp"

namespace remapc {

// Fits `rows` (all of status ok, finite). Roughness is regressed from roughness alone unless
// alpha_needs_specular(). Rows with the same inputs count as one sample with their mean output: the published
// table holds some twenty rows of target alpha for each alpha1, and their mean says the same in a hundredth
// of the time. Hyper-parameters are chosen by cross-validation inside `rows` (svr_search.hpp); the model is
// then trained on all samples, or on 2000 drawn evenly where there are more (`method` says so).
// Throws kInput for fewer than 10 rows or where an input is constant, kUsage for hyper-parameters out of
// range, kNumeric where libsvm refuses or does not converge with given hyper-parameters; searched ones are
// softened until it does. libsvm then writes a line of its own to standard error, which it cannot be asked
// not to.
// What `progress` throws ends the fit after the trainings that are under way, a few seconds.
//
// `method` holds for each output, after "alpha." or "specular.": C, gamma, epsilon, specular_span,
// alpha_pole, inputs, vectors, trained_samples, and of a search folds, candidates, search_samples and
// cross_validation_rms (in the output's own unit).
Regression fit_svr(const std::vector<TableRow>& rows, const SvrOptions& options,
                   const FitProgress& progress = {});

// The hyper-parameters that a fitted mapping's `method` records, for fitting other rows with them, number for
// number; those that it does not record stay as in `base`. Throws kInput where it records half of them or no
// number.
SvrOptions options_from_method(const std::map<std::string, std::string>& method, const SvrOptions& base);

}  // namespace remapc
