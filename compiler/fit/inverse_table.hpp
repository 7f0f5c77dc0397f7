// The table of the way back through a fit, for a fit of its own.
#pragma once

#include <string_view>

#include "model/fit.hpp"
#include "table/table.hpp"

namespace remapc {

// Samples of the target's parameters with the source's that `fit` takes to them (model/inverse.hpp): `fit`'s
// target is the table's source. `alpha_count` widths over those that the fit gives at its least sample, and
// `specular_count` values up to the largest that it gives at every width. Rows that no source parameter in
// the fit's domain gives are clamped, or flat where even black gives more. `bytes`: the fit file, whose
// SHA-256 is recorded. Not matched by pictures: errors are NaN.
Table inverse_table(const remap::Fit& fit, std::string_view bytes, std::size_t alpha_count = 48,
                    std::size_t specular_count = 10);

}  // namespace remapc
