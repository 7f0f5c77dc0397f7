// This file reads and writes parts of fit files and converter files as JSON. The readers throw kInput.
#pragma once

#include <optional>
#include <string>

#include "converter/converter_data.hpp"
#include "core/json_field.hpp"

namespace remap {

// This program reads and writes this version of fit files.
inline constexpr int kFitFormatVersion = 4;

// Throws kInput if `root` is not the root of a fit file of this version.
void require_fit_file(const Field& root);
// Returns true if the file holds a fit of whole materials. Its ends are workflows.
bool is_of_materials(const Field& root);

// Reads `[min, max]` with min < max.
Range read_range(const Field& field);

// Reads `{"model": ..., "roughness": ..., "specular": ...}`. The names must be valid in generated code.
ModelSide read_side(const Field& field);
Json side_json(const ModelSide& side);
Json domain_json(const ConverterInfo& info);
// Returns the errors of the fit. An unknown error becomes null.
Json errors_json(const ConverterInfo& info);
// Returns the SSIM of the fit's spheres, or null if it is unknown.
Json ssim_json(const ConverterInfo& info);
std::string read_id(const Field& field);
std::string read_model(const Field& field);

// Reads the version from a text such as `remapc 1.2.3`.
std::string read_tool_version(const Field& field);

// Returns `value`. Throws kNumeric if it is not finite.
double finite(double value);

// Returns the section `converter` of a fit file. Throws kNumeric if a number is not finite.
std::string converter_to_json(const ConverterData& converter);
ConverterData read_converter(const Field& field);
// Reads the converter of the fit file with this root. Returns nothing if the fit has no converter because it
// could not be lowered. Throws kInput if the file has no section `converter`.
std::optional<ConverterData> read_fitted_converter(const Field& root);
// Messages about files without a converter end with this advice.
inline constexpr const char* kMakeAgain = "run remapc fit again, or chain, invert or build";

}  // namespace remap
