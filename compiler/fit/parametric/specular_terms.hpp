// The specular half of the parametric regression: curves of exponentials over alpha, one for each power of
// specular, all at once.
#pragma once

#include <vector>

#include "fit/parametric/parametric_form.hpp"
#include "model/mapping.hpp"
#include "table/table.hpp"

namespace remapc {

// The terms of `form` that minimise the squared error in specular2 over the rows. Linear coefficients by
// least squares for given rates, rates by a grid of starts and Ceres (variable projection). `near`: terms of
// the same form whose rates are the only start, for rows that are much like those that gave them. Throws
// kInput for rows with too few different alpha1 (6) or specular1 (one a power), kNumeric where no start
// converges.
std::vector<remap::SpecularTerm> fit_specular_terms(const std::vector<TableRow>& rows,
                                                    const SpecularForm& form,
                                                    const std::vector<remap::SpecularTerm>* near = nullptr);

}  // namespace remapc
