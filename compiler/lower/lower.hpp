// Lowers a mapping to the compact form, with an error bound that is proven over the whole domain.
#pragma once

#include "lower/fit.hpp"

namespace remap {

struct LoweringOptions {
  // Pictures do not show a quarter of an 8-bit step.
  double alpha_tolerance = 1e-3;     // absolute, target alpha
  double specular_tolerance = 1e-3;  // relative to the largest target specular over the domain
};

struct Lowered {
  CompactForm form;
  // Proven: |form in float arithmetic - mapping| over the whole domain, below the limits.
  double alpha_bound = 0.0, specular_bound = 0.0;
};

// The form with the fewest terms that meets the tolerances, or that is nearest to them; a compact fit as it
// is. Throws kNumeric where none is proven within ten times the tolerances.
Lowered lower(const Fit& fit, const LoweringOptions& options = {});

// Lowers the fit and sets fit->converter. Takes up to a second. Throws as lower(), and leaves the fit as it
// is.
void add_converter(Fit* fit, const LoweringOptions& options = {});

}  // namespace remap
