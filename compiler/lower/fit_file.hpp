// This file holds fits of whole materials, and reads and writes the files of fits of every type (JSON).
// Numbers round-trip exactly, and equal fits give equal bytes everywhere. Limits of the numbers in a fit are
// several times as large as any fit that remap ships or finds. A fit at the limits can still be shown,
// emitted and applied in a few seconds.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lower/fit.hpp"
#include "reference/workflow_conversion.hpp"
#include "remap/error.hpp"
#include "remap/warp.hpp"
#include "stages/warp_json.hpp"

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

// An AnyFit is a fit of any type that a file can contain.
using AnyFit = std::variant<Fit, WorkflowFit, WarpMapFit>;

inline const std::string& fit_id(const AnyFit& fit) {
  return std::visit([](const auto& any) -> const std::string& { return any.id; }, fit);
}

// Returns the JSON text of a fit, which ends with a newline. Throws kNumeric if a number is not finite, and
// the errors of require_valid().
std::string fit_to_json(const Fit& fit);
std::string fit_to_json(const WorkflowFit& fit);

// Reads the fit of alpha and specular in `json`. Messages begin with `context`, a file name. Throws kInput
// for invalid JSON, another format version, a missing or mistyped field, an unknown kind, or an invalid id.
// Also throws it for an empty domain, a coefficient that is not finite, and a fit of whole materials.
Fit fit_from_json(std::string_view json, const std::string& context);

// Reads a fit of alpha and specular from a file. Throws kInput if it cannot be read.
Fit load_fit(const std::filesystem::path& path);

// These functions read and write fits of all types. They throw the same errors.
AnyFit any_fit_from_json(std::string_view json, const std::string& context);
AnyFit load_any_fit(const std::filesystem::path& path);

// Returns the fit if it maps alpha and specular. For a fit of whole materials, throws an error of `kind` that
// begins with `context`.
const Fit& require_width_and_specular(const AnyFit& fit, ErrorKind kind, const std::string& context);

// These limit a parametric mapping: powers of specular, powers of alpha, and terms of specular.
inline constexpr std::size_t kMostSpecularPowers = 16, kMostAlphaPowers = 32, kMostTerms = 64;
// This limits the number of Gaussians for each output.
inline constexpr std::size_t kMostVectors = 4096;
// These limit every network.
inline constexpr std::size_t kMostLayers = 6, kMostNetworkNumbers = 20'000;
// This limits alpha and specular of a source. Physical values are at most 1, and scales of some models are
// below 10.
inline constexpr double kLargestDomain = 1000.0;

// Returns which part of a fit or a network exceeds a limit: `has 5000 support vectors; at most 4096 are
// possible`. Returns an empty text if no part does.
std::string oversize(const Fit& fit);
std::string oversize(const Network& network);

}  // namespace remap
