// This file reads and writes warp fits as JSON.
#pragma once

#include <string>

#include "remap/warp.hpp"

namespace remap {

class Field;

// Returns the text of the file, which ends with a newline. Throws the errors of require_valid().
std::string fit_to_json(const WarpMapFit& fit);

// Reads the fit with this root of its file. Throws kInput.
WarpMapFit read_warp_fit(const Field& root);

}  // namespace remap
