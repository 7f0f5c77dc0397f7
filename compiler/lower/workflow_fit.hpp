// This file holds a conversion of whole materials, in closed form or by a trained network. It is a separate
// type from a fit of alpha and specular (fit.hpp), because it has other inputs and outputs.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lower/fit.hpp"
#include "reference/workflow_conversion.hpp"

namespace remap {

// A NetworkTraining records how a network was trained. Errors are over the held-out rows.
struct NetworkTraining {
  std::map<std::string, std::string> method;  // shape, optimisers, starts
  ErrorFigures base_color;                    // over all channels, linear
  ErrorFigures metallic;
  Split split;
  TableRecord table;
  bool operator==(const NetworkTraining&) const = default;
};

// A WorkflowFit is of kind `workflow`, or `mlp` if the formula is a network.
struct WorkflowFit {
  std::string id;
  WorkflowConversion conversion;
  std::optional<NetworkTraining> training;  // set for a network
  std::vector<std::string> remarks;         // lines of the model card (remapc show)
  std::string tool_version;
  bool operator==(const WorkflowFit&) const = default;
};

inline constexpr const char* kWorkflowKind = "workflow";

inline const char* material_kind(const WorkflowFit& fit) {
  return is_learned(fit.conversion.formula) ? "mlp" : kWorkflowKind;
}

}  // namespace remap
