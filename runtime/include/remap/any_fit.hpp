// The fits that a fit file can hold.
#pragma once

#include <string>
#include <variant>

#include "remap/fit.hpp"
#include "remap/warp_fit.hpp"
#include "remap/workflow_fit.hpp"

namespace remap {

// The version of the file format that this program reads and writes.
inline constexpr int kFitFormatVersion = 3;

using AnyFit = std::variant<Fit, WorkflowFit, WarpMapFit>;

inline const std::string& fit_id(const AnyFit& fit) {
  return std::visit([](const auto& any) -> const std::string& { return any.id; }, fit);
}

}  // namespace remap
