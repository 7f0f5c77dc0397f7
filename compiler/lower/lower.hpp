// Lowers a mapping to piecewise polynomials, with an error bound that is proven over the whole domain.
#pragma once

#include "converter/lowered.hpp"
#include "lower/fit.hpp"

namespace remap {

struct LoweringOptions {
  double alpha_tolerance = 1e-5;     // absolute, target alpha
  double specular_tolerance = 1e-4;  // relative to the largest target specular over the domain
};

// Lowers both outputs of a mapping. If the mapping rises with alpha or with specular (on a dense grid), the
// polynomials do, too (proven), if a shape within the tolerance does. Throws kNumeric if a tolerance cannot
// be met by a table of 2048 numbers; the message has one with which lowering succeeds.
Lowered lower(const MappingKind& mapping, const Domain& domain, const LoweringOptions& options = {});

// The same with the regimes of the fit, each over the part of the domain where it is evaluated.
Lowered lower(const Fit& fit, const LoweringOptions& options = {});

// Lowers the fit and sets fit->converter. Takes up to a second. Throws as lower(), and leaves the fit as it
// is.
void add_converter(Fit* fit, const LoweringOptions& options = {});

}  // namespace remap
