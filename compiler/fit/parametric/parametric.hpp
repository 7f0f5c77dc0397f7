// The parametric regression of section 7 (Sztrajman et al. 2019) and its extensions: roughness as a
// polynomial, specular as curves of exponentials.
#pragma once

#include <cstdint>
#include <string>

#include "fit/parametric/parametric_form.hpp"
#include "fit/rows/regression.hpp"

namespace remapc {

// Fits `form` to the rows by least squares, separately for target alpha and target specular. `domain`: the
// range in which the curves must be sound. A curve is sound if alpha2 increases with alpha1 at every
// specular; if the factor of a proportional specular is positive, or otherwise specular2 increases with
// specular1 and is positive at the least specular of the rows. `near`: a fit of the same form to similar
// rows, used as the start. Throws kInput for too few distinct alpha1 or specular1, kNumeric with the place if
// the solver does not converge or a curve is not sound.
remap::Parametric fit_parametric(const std::vector<TableRow>& rows, const remap::Domain& domain,
                                 const ParametricForm& form, const remap::Parametric* near = nullptr);

struct ParametricOptions {
  std::string form;  // a name of find_form(); empty: choose one
  std::uint64_t seed = 1;
  std::size_t folds = 10;
  unsigned jobs = 0;  // threads; 0: one per core. The result does not depend on it
};

// Chooses a form for each output by cross-validation within the rows: the form with the fewest coefficients
// whose error is within one standard error, or within kNegligibleError (folds.hpp), of the best. Forms that
// the rows do not determine or that are not sound are excluded. `method` records the choice and the errors.
// Throws the errors of fit_parametric() for the paper's form if no form remains.
Regression fit_parametric_best(const std::vector<TableRow>& rows, const remap::Domain& domain,
                               const ParametricOptions& options, const FitProgress& progress = {});

}  // namespace remapc
