// This file does support vector regression (Sztrajman et al. 2019, section 5.1) with libsvm. It uses
// epsilon-SVR with radial basis functions, and one model per output.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fit/svr/svm_training.hpp"
#include "table/regression.hpp"

namespace remap {

struct SvrOptions {
  std::uint64_t seed = 1;  // seed for the folds of the search and for drawing samples
  unsigned jobs = 0;       // threads; 0: one per core. The result does not depend on it
  // If hyper-parameters are missing, they are searched.
  std::optional<SvrHyperParameters> alpha, specular;
};

// Fits `rows` (all of status ok, finite). If alpha_needs_specular() returns false, target alpha is fitted
// from source alpha only. Rows with the same inputs are combined to one sample with their mean output. The
// published table has about twenty rows for each alpha1, and their mean target alpha gives the same fit in a
// hundredth of the time. Hyper-parameters are chosen by cross-validation within `rows` (svr_search.hpp). The
// model is then trained on all samples. If there are more than 2000, it is trained on 2000 samples, evenly
// drawn, which `method` records. Throws kInput for fewer than 10 rows or a constant input, and kUsage for
// hyper-parameters out of range. Throws kNumeric if libsvm does not converge with given hyper-parameters. If
// they were searched, C is reduced until it converges. libsvm then prints a warning to standard error, which
// cannot be disabled. An exception from `progress` ends the fit after the current trainings, within a few
// seconds.
//
// `method` has these entries for each output, with the prefix `alpha.` or `specular.`: C, gamma, epsilon,
// specular_span, alpha_pole, inputs, vectors, trained_samples. After a search, it also has folds, candidates,
// search_samples and cross_validation_rms (in the unit of the output).
Regression fit_svr(const std::vector<TableRow>& rows, const SvrOptions& options,
                   const FitProgress& progress = {});

}  // namespace remap
