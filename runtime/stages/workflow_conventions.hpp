// This file prepares the conventions of both workflows for the formulas.
#pragma once

#include <string>

#include "remap/workflow.hpp"
#include "stages/workflow_code.hpp"

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
