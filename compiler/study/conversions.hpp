// What the methods of the study of environments make of the source materials.
#pragma once

#include <string>
#include <vector>

#include "study/environments_options.hpp"

namespace remapc {

// Every pair and alpha by every method that the pair has, by alpha, pair, method. A pair without a fit among
// `options.fits` adds a sentence to `remarks`.
std::vector<Conversion> conversions_of(const EnvironmentsOptions& options, std::vector<std::string>* remarks);

}  // namespace remapc
