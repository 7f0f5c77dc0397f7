// The difference between the compiled converter and the exact copy of template texels.
#pragma once

#include "warp/warp.hpp"

namespace remapc {

// RMS distance in the template's appearance space between the results of the compiled converter and of
// copy_exactly(), relative to the template's spread. Uses at most 2^14 source texels and 2^18 template
// texels, both evenly spread.
double copy_rms_error(const WarpFit& fit, const WarpMaterial& source, const WarpMaterial& target);

}  // namespace remapc
