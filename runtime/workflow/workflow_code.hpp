// The formulas of workflow conversions: the very text that generated headers hold
// (compiler/emit/workflow_code.cpp), so that both give the same bits; and, for this program alone, those of
// the diagnosis.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__clang__)  // a loop that cannot be vectorised is no fault
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wpass-failed"
#endif

namespace remap::workflow_code {
// Each needs those before it.
// clang-format off
#include "workflow/code/floats.inc"
#include "workflow/code/conventions.inc"
#include "workflow/code/rows.inc"
#include "workflow/code/width.inc"
#include "workflow/code/metallic_to_specular.inc"
#include "workflow/code/specular_texels.inc"
#include "workflow/code/projection.inc"
#include "workflow/code/diagnosis.inc"
#include "workflow/code/equation_3.inc"
#include "workflow/code/khronos.inc"
// clang-format on
}  // namespace remap::workflow_code

#if defined(__clang__)
#pragma clang diagnostic pop
#endif
