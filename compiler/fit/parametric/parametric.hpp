// This file does the parametric regression of section 7 (Sztrajman et al. 2019). Target alpha is a polynomial
// of source alpha, and target specular is source specular times a curve of exponentials, k(alpha).
#pragma once

#include <string>

#include "table/regression.hpp"

namespace remap {

// Returns true for the form `paper+pole`, whose curve has the term c5 / alpha of the authors' scripts.
// Returns false for `paper` and for an empty name. Throws kUsage for other names.
bool has_pole(const std::string& form);

// Fits the form to the rows by least squares, separately for target alpha and target specular. Target alpha
// must increase with source alpha everywhere in `domain`, and k(alpha) must be positive. Otherwise, throws
// kNumeric with the place. Also throws it if the solver does not converge. Throws kInput for too few distinct
// alpha1.
Regression fit_parametric(const std::vector<TableRow>& rows, const Domain& domain,
                          const std::string& form = "paper");

}  // namespace remap
