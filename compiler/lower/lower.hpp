// This file replaces a mapping by a form of a few numbers (lowers it), with an error bound that is proven
// over the whole domain.
#pragma once

#include "lower/fit.hpp"

namespace remap {

// This tolerance is a quarter of an 8-bit step, which pictures do not show. It is absolute for target alpha,
// and relative to the largest target specular over the domain.
inline constexpr double kLoweringTolerance = 1e-3;

// Returns the form with the fewest terms that meets the tolerance, or that comes closest. A compact fit stays
// unchanged. The bounds are proven for |form in float arithmetic - mapping| over the whole domain, below the
// limits. Sets only the form and the bounds of the result. Throws kNumeric if no form is proven within ten
// times the tolerance.
ConverterData lower(const Fit& fit, double tolerance = kLoweringTolerance);

// Lowers the fit and sets fit->converter. Takes up to a second. If it throws like lower(), the fit is
// unchanged.
void add_converter(Fit* fit, double tolerance = kLoweringTolerance);

}  // namespace remap
