// The parametric regression of section 7 (Sztrajman et al. 2019): quartic roughness, slope k(alpha) of
// exponentials.
#pragma once

#include <vector>

#include "model/fit.hpp"
#include "table/table.hpp"

namespace remapc {

// Fits the form to the rows in least squares: the quartic without constant term to alpha2, one slope through
// the origin for each source width, then k to those slopes, each weighted by the sum of its squared
// speculars, so that the error in specular is what is minimised. `domain`: where the roughness curve has to
// rise and k to be positive. Throws kInput for fewer than 6 source widths, kNumeric where the solver does not
// converge, and where the curve does not rise, with the alpha at which it bends.
remap::Parametric fit_parametric(const std::vector<TableRow>& rows, const remap::Range& domain);

}  // namespace remapc
