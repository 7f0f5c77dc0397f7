// The constants of a conversion for its formulas.
#pragma once

#include "remap/workflow.hpp"
#include "stages/workflow_code.hpp"

namespace remap {

workflow_code::WidthParameter width_parameter(RoughnessConvention width);
workflow_code::Conventions conventions_of(const WorkflowConversion& conversion);

}  // namespace remap
