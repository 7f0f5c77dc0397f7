// This file does the parametric regression of section 7 (Sztrajman et al. 2019). Roughness is a polynomial,
// specular a curve of exponentials.
#pragma once

#include <string>

#include "fit/parametric/parametric_form.hpp"
#include "table/regression.hpp"

namespace remap {

// Fits `form` to the rows by least squares, separately for target alpha and target specular. The curves must
// be sound in `domain`. A curve of alpha is sound if alpha2 increases with alpha1 at every specular. A
// proportional specular needs a positive factor. Otherwise specular2 must increase with specular1 and be
// positive at the least specular of the rows. Throws kInput for too few distinct alpha1 or specular1. Throws
// kNumeric with the place if the solver does not converge or a curve is not sound.
Parametric fit_parametric(const std::vector<TableRow>& rows, const Domain& domain,
                          const ParametricForm& form);

// `form` is a name of find_form(). If it is empty, the paper's form is fitted.
Regression fit_parametric_kind(const std::vector<TableRow>& rows, const Domain& domain,
                               const std::string& form);

// The following functions, and fit_specular_terms(), are for code that chooses a form, or fits a form again.

// Returns the least squares coefficients for alpha2. Throws kInput if the rows do not determine them.
std::vector<std::vector<double>> fit_roughness(const std::vector<TableRow>& rows, const ParametricForm& form);

// Throws kNumeric with the place if alpha2 does not increase with alpha1 everywhere in `domain`.
void require_rising_alpha(const Parametric& form, const Domain& domain);

// Throws kNumeric with the place if a proportional factor is not positive, or otherwise if specular2 does not
// increase with specular1 or is negative at `least_specular`.
void require_rising_specular(const Parametric& form, const Domain& domain, double least_specular);

// Returns the least specular1 above 0.
double least_positive_specular(const std::vector<TableRow>& rows);

}  // namespace remap
