// The formulas of workflow conversions, from the same text as generated headers
// (compiler/emit/workflow_code.cpp) so that both give the same bits, and those of the diagnosis, which only
// this program uses.
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

namespace remap::workflow_code {
// Each depends on those before it.
// clang-format off
#include "stages/code/bits.inc"
#include "stages/code/floats.inc"
#include "stages/code/conventions.inc"
#include "stages/code/rows.inc"
#include "stages/code/width.inc"
#include "stages/code/metallic_to_specular.inc"
#include "stages/code/specular_texels.inc"
#include "stages/code/projection.inc"
#include "stages/code/diagnosis.inc"
// clang-format on
}  // namespace remap::workflow_code

#if defined(__clang__)
#pragma clang diagnostic pop
#endif
