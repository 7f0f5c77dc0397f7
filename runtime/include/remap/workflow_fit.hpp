// A conversion of whole materials: in closed form, or by a network learned from a table. It has other inputs
// and outputs than a fit of width and specular (fit.hpp) and no domain but 0 to 1; so it is a type of its
// own, and what takes one kind says which.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "remap/fit.hpp"
#include "remap/workflow.hpp"

namespace remap {

// How a network was learned. Errors are those of the rows that were held out.
struct NetworkTraining {
  std::map<std::string, std::string> method;  // shape, optimisers, starts
  ErrorFigures base_color;                    // over all channels, linear
  ErrorFigures metallic;
  Split split;
  TableRecord table;
  bool operator==(const NetworkTraining&) const = default;
};

// Kind `analytic`, or `mlp` where the formula is a network.
struct WorkflowFit {
  std::string id;  // as of every fit
  WorkflowConversion conversion;
  std::optional<NetworkTraining> training;  // of a network; else none
  std::vector<std::string> remarks;         // for the card, a line each
  std::string tool_version;
  bool operator==(const WorkflowFit&) const = default;
};

inline constexpr const char* kWorkflowKind = "analytic";

inline const char* material_kind(const WorkflowFit& fit) {
  return is_learned(fit.conversion.formula) ? "mlp" : kWorkflowKind;
}

}  // namespace remap
