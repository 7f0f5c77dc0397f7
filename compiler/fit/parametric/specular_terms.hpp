// This file fits the specular part of the parametric regression. It fits one curve of exponentials over alpha
// for each power of specular, all at once.
#pragma once

#include <vector>

#include "fit/parametric/parametric_form.hpp"
#include "lower/mapping.hpp"
#include "table/table.hpp"

namespace remap {

// Returns the terms of `form` that minimize the squared error in specular2 over the rows, by variable
// projection. Ceres searches the rates from a grid of starts, and least squares gives the linear coefficients
// for them. `near` holds terms of the same form, fitted to similar rows. Their rates are the only start if it
// converges. Throws kInput for rows with too few distinct alpha1 (6) or specular1 (one per power), and
// kNumeric if no start converges.
std::vector<SpecularTerm> fit_specular_terms(const std::vector<TableRow>& rows, const ParametricForm& form,
                                             const std::vector<SpecularTerm>* near = nullptr);

}  // namespace remap
