// Parts of files of fits and converters as JSON. Readers throw kInput.
#pragma once

#include <optional>
#include <string>

#include "converter/converter_data.hpp"
#include "core/json_field.hpp"

namespace remap {

// The version of fit files that this program reads and writes.
inline constexpr int kFitFormatVersion = 4;

// Throws kInput unless `root` begins a fit file of this version.
void require_fit_file(const Field& root);
// Whether the fit of the file is one of whole materials. Their ends name workflows.
bool is_of_materials(const Field& root);

// `[min, max]` with min < max.
Range read_range(const Field& field);

// `{"model": ..., "roughness": ..., "specular": ...}`, names that can stand in generated code.
ModelSide read_side(const Field& field);
Json side_json(const ModelSide& side);
Json domain_json(const ConverterInfo& info);
// The errors of the fit; null for an unknown error.
Json errors_json(const ConverterInfo& info);
// The SSIM of its spheres; null for an unknown one.
Json ssim_json(const ConverterInfo& info);
std::string read_id(const Field& field);
std::string read_model(const Field& field);

// Of `remapc 1.2.3`.
std::string read_tool_version(const Field& field);

// The number itself. Throws kNumeric where it is not finite.
double finite(double value);

// The section `converter` of a fit file. Throws kNumeric where a number is not finite.
std::string converter_to_json(const ConverterData& converter);
ConverterData read_converter(const Field& field);
// That of the fit file with this root; none where the fit could not be lowered. Throws kInput, also where the
// file has no such section.
std::optional<ConverterData> read_fitted_converter(const Field& root);
// The advice for a file without a converter.
inline constexpr const char* kMakeAgain = "run remapc fit again, or chain, invert or build";

}  // namespace remap
