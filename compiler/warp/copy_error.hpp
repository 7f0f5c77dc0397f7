// How far the compiled converter is from the exact copy of template texels.
#pragma once

#include "warp/warp.hpp"

namespace remapc {

// RMS distance in the template's appearance space between what the compiled converter gives and what
// copy_exactly() does, in shares of the template's spread. Over at most 2^14 source texels and copies of at
// most 2^18 template texels, both evenly spread.
double copy_rms_error(const WarpFit& fit, const WarpMaterial& source, const WarpMaterial& target);

}  // namespace remapc
