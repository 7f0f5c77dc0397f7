// Warp fits as JSON.
#pragma once

#include <string>

#include "remap/warp.hpp"

namespace remap {

class Field;

// The text of the file, ending with a newline. Throws the errors of require_valid().
std::string fit_to_json(const WarpMapFit& fit);

// The fit whose file has this root. Throws kInput.
WarpMapFit read_warp_fit(const Field& root);

}  // namespace remap
