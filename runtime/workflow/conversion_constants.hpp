// A conversion as the constants of its formulas; for those who run them.
#pragma once

#include "remap/workflow.hpp"
#include "workflow/workflow_code.hpp"

namespace remap {

workflow_code::WidthParameter width_parameter(RoughnessConvention width);
workflow_code::Conventions conventions_of(const WorkflowConversion& conversion);

}  // namespace remap
