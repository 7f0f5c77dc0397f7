// The parametric regression of section 7 (Sztrajman et al. 2019) and its extensions: roughness as a
// polynomial, specular as curves of exponentials.
#pragma once

#include <cstdint>
#include <string>

#include "fit/parametric/parametric_form.hpp"
#include "fit/rows/regression.hpp"

namespace remapc {

// Fits `form` to the rows in least squares, target alpha and target specular each by itself. `domain`: where
// the curves have to be sound, that is: alpha2 rises with alpha1 at every specular; where specular is
// proportional its factor is positive; else specular2 rises with specular1, and is positive at the least
// specular of the rows. `near`: a fit of the same form to much the same rows, as the start. Throws kInput for
// too few different alpha1 or specular1, kNumeric where the solver does not converge or a curve is not sound,
// with the place.
remap::Parametric fit_parametric(const std::vector<TableRow>& rows, const remap::Domain& domain,
                                 const ParametricForm& form, const remap::Parametric* near = nullptr);

struct ParametricOptions {
  std::string form;  // a name of find_form(); empty: chosen
  std::uint64_t seed = 1;
  std::size_t folds = 10;
  unsigned jobs = 0;  // threads; 0: one a processor. The result does not depend on it
};

// Chooses for each output by cross-validation within the rows: the form with the fewest coefficients whose
// error is within one standard error of the best, or within kNegligibleError (folds.hpp) of it. Forms that
// the rows cannot carry, or that are not sound, take no part. `method` records the choice and the errors it
// was made from. Throws what fit_parametric() throws for the paper's form where no form is left.
Regression fit_parametric_best(const std::vector<TableRow>& rows, const remap::Domain& domain,
                               const ParametricOptions& options, const FitProgress& progress = {});

}  // namespace remapc
