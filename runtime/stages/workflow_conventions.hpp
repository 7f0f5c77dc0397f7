// This file holds the formulas of workflow conversions, and prepares the conventions of both workflows for
// them. Generated headers have the same text (compiler/emit/header_code.cpp), so that both give the same
// bits. Only the formulas of the diagnosis are not in headers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "remap/workflow.hpp"

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

namespace remap {

// Throws kInput, beginning with `context`, for a width other than roughness, glossiness or alpha, and for a
// dielectric F0 out of range.
void require_valid(const SpecularWorkflow& specular, const MetallicWorkflow& metallic,
                   const std::string& context);
// Throws kInput, beginning with `context`, for a prior out of range.
void require_prior(double prior, const std::string& context);

workflow_code::WidthParameter width_parameter(RoughnessEncoding width);
// Returns the conventions of a conversion to metallic, or to specular.
workflow_code::Conventions conventions_of(const SpecularWorkflow& specular, const MetallicWorkflow& metallic,
                                          bool to_metallic);

}  // namespace remap
