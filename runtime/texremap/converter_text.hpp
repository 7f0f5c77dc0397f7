// How commands show converters and paths, to people and as JSON.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "convert/path.hpp"

namespace remap {

using Json = nlohmann::ordered_json;

// `alpha 0.01 to 1`.
std::string range_text(std::string_view name, const Range& range);

// `alpha 0.01 to 1, specular 0 to 0.5`: what a converter covers of its source.
std::string domain_text(const ConverterInfo& info);

// An error figure, rounded up to two digits.
std::string figure_text(double error);

// An expected error, which is an estimate, rounded up to three digits.
std::string expected_text(double error);

// `image 0.059, fit rms 0.00026 in alpha and 4.1e-05 in f0`.
std::string errors_text(const ConverterInfo& info);

// `mitsuba/ward -> mitsuba/beckmann -> mitsuba/ggx`.
std::string models_text(const ConverterPath& path);

Json side_json(const ModelSide& side);
Json domain_json(const ConverterInfo& info);
// Of the fit, and null for an image error that is unknown.
Json errors_json(const ConverterInfo& info);
// The ids of the steps.
Json path_json(const ConverterPath& path);

}  // namespace remap
