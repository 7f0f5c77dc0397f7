// The pass of a compiled warp over rows of texels.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__clang__)  // silences the warning about loops that cannot be vectorised
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wpass-failed"
#endif

namespace remap::warp_code {
// Each depends on those before it.
// clang-format off
#include "workflow/code/floats.inc"
#include "workflow/code/rows.inc"
#include "warp/code/appearance.inc"
#include "warp/code/separable.inc"
#include "warp/code/quadratic.inc"
#include "warp/code/blended.inc"
#include "warp/code/copied.inc"
#include "warp/code/warp_block.inc"
// clang-format on
}  // namespace remap::warp_code

#if defined(__clang__)
#pragma clang diagnostic pop
#endif
