// The two halves of the parametric regression, for the code that chooses a form for each.
#pragma once

#include <vector>

#include "fit/parametric/parametric_form.hpp"
#include "remap/fit.hpp"
#include "table/table.hpp"

namespace remapc {

// The least squares coefficients for alpha2. Throws kInput if the rows do not determine them.
std::vector<std::vector<double>> fit_roughness(const std::vector<TableRow>& rows, const RoughnessForm& form);

// Throws kNumeric with the place if alpha2 does not increase with alpha1 everywhere in `domain`.
void require_rising_alpha(const remap::Parametric& form, const remap::Domain& domain);

// Throws kNumeric with the place if a proportional factor is not positive, or otherwise if specular2 does not
// increase with specular1 or is negative at `least_specular`.
void require_rising_specular(const remap::Parametric& form, const remap::Domain& domain,
                             double least_specular);

// The least specular1 above 0.
double least_positive_specular(const std::vector<TableRow>& rows);

}  // namespace remapc
