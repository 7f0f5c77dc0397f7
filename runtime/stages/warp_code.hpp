// This file runs a compiled warp over rows of texels.
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
// Each file depends on the files before it.
// clang-format off
#include "stages/code/bits.inc"
#include "stages/code/floats.inc"
#include "stages/code/rows.inc"
#include "stages/code/appearance.inc"
#include "stages/code/separable.inc"
#include "stages/code/quadratic.inc"
#include "stages/code/blended.inc"
#include "stages/code/copied.inc"
#include "stages/code/warp_block.inc"
// clang-format on
}  // namespace remap::warp_code

#if defined(__clang__)
#pragma clang diagnostic pop
#endif
