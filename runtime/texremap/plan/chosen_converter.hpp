// This file chooses the converter of a run over texture sets, and the workflows around it.
#pragma once

#include <string>

#include "remap/conversion.hpp"
#include "texremap/plan/workflow_choice.hpp"

namespace remap {

struct ChosenConverter : BuiltConversion {
  WorkflowChoice workflow;
};

// Returns a text such as `diffuse plain, dielectric F0 0.04`.
std::string conventions_text(const WorkflowEnd& end);

// Returns the text that results store as `remap:converter`: the ids of steps, and a workflow's formula.
std::string converter_ids(const ChosenConverter& chosen);

}  // namespace remap
