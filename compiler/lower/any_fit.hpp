// This file lists all types of fits that a fit file can contain.
#pragma once

#include <string>
#include <variant>

#include "lower/fit.hpp"
#include "lower/workflow_fit.hpp"
#include "remap/warp.hpp"

namespace remap {

using AnyFit = std::variant<Fit, WorkflowFit, WarpMapFit>;

inline const std::string& fit_id(const AnyFit& fit) {
  return std::visit([](const auto& any) -> const std::string& { return any.id; }, fit);
}

}  // namespace remap
