// This file makes the table of the inverse of a fit. It can be fitted like any other table.
#pragma once

#include <string_view>

#include "lower/fit.hpp"
#include "table/table.hpp"

namespace remap {

// Samples the target parameters of `fit` and finds the source parameters that `fit` converts to them
// (lower/chain.hpp). The target of `fit` becomes the source of the table. `alpha_count` alphas cover the
// range that `fit` reaches at its least specular sample. `specular_count` speculars go up to the largest that
// `fit` reaches at every alpha. If no source parameters in the domain give a row's target, the row is
// clamped. It is flat if even specular 0 gives more. `bytes` is the fit file, whose SHA-256 is recorded.
// Errors are NaN, because no pictures are compared.
Table inverse_table(const Fit& fit, std::string_view bytes, std::size_t alpha_count = 48,
                    std::size_t specular_count = 10);

}  // namespace remap
