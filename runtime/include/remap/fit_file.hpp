// The fit file: JSON in and out. Numbers round-trip exactly; the same fit gives the same bytes on every
// machine.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "remap/any_fit.hpp"
#include "remap/error.hpp"
#include "remap/fit.hpp"

namespace remap {

// The JSON text of a fit, ending with a newline. Throws kNumeric where a number is not finite; kInput for an
// analytic fit that require_valid() refuses.
std::string fit_to_json(const Fit& fit);
std::string fit_to_json(const WorkflowFit& fit);
std::string fit_to_json(const WarpMapFit& fit);

// The fit that `json` holds. `place` (a file name) opens every message. Throws kInput for text that is no
// JSON, another format version, a missing or mistyped field, an unknown kind, an id that is no identifier, a
// domain that is empty, a coefficient that is not finite, an analytic fit.
Fit fit_from_json(std::string_view json, const std::string& place);

// The same for a file. Throws kInput where it cannot be read.
Fit load_fit(const std::filesystem::path& path);

// The same for whatever a fit file can hold.
AnyFit any_fit_from_json(std::string_view json, const std::string& place);
AnyFit load_any_fit(const std::filesystem::path& path);

// The fit of width and specular that `fit` is. Throws an error of `kind`, opened by `place`, for one of
// whole materials, which says what can be done with it.
const Fit& require_width_and_specular(const AnyFit& fit, ErrorKind kind, const std::string& place);

}  // namespace remap
