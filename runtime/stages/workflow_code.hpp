// This file holds the formulas of workflow conversions. Generated headers have the same text
// (compiler/emit/workflow_code.cpp), so that both give the same bits. Only the formulas of the diagnosis are
// not in headers.
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
// Each file depends on the files before it.
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
