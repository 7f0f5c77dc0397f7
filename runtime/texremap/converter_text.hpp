// Converters and paths as text and as JSON, for all commands.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "remap/path.hpp"

namespace remap {

using Json = nlohmann::ordered_json;

// `alpha 0.01 to 1`.
std::string range_text(std::string_view name, const Range& range);

// `alpha 0.01 to 1, specular 0 to 0.5`: the domain of a converter.
std::string domain_text(const ConverterInfo& info);

// An RMS error, rounded up to two digits.
std::string figure_text(double error);

// An expected error, rounded up to three digits. It is an estimate.
std::string expected_text(double error);

// `image 0.059, fit rms 0.00026 in alpha and 4.1e-05 in f0`.
std::string errors_text(const ConverterInfo& info);

// `mitsuba/ward -> mitsuba/beckmann -> mitsuba/ggx`.
std::string models_text(const ConverterPath& path);

Json side_json(const ModelSide& side);
Json domain_json(const ConverterInfo& info);
// The errors of the fit; null for an unknown error.
Json errors_json(const ConverterInfo& info);
// The ids of the steps.
Json path_json(const ConverterPath& path);

}  // namespace remap
