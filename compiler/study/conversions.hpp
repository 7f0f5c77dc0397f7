// The target materials that each method of the environments study computes.
#pragma once

#include <string>
#include <vector>

#include "study/environments_options.hpp"

namespace remapc {

// Returns every pair and alpha converted by every method that applies to the pair, sorted by alpha, pair and
// method. Adds a remark for each pair without a fit in `options.fits`.
std::vector<Conversion> conversions_of(const EnvironmentsOptions& options, std::vector<std::string>* remarks);

}  // namespace remapc
