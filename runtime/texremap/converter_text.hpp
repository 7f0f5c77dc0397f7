// Converters and paths as text and as JSON, for all commands.
#pragma once

#include <string>
#include <string_view>

#include "core/json.hpp"
#include "remap/path.hpp"

namespace remap {

// Pictures differ by this times the residual of metal-rough, on the mean.
inline constexpr double kPictureOfResidual = 0.42;

// `alpha 0.01 to 1`.
std::string range_text(std::string_view name, const Range& range);

// `alpha 0.01 to 1, specular 0 to 0.5`: the domain of a converter.
std::string domain_text(const ConverterInfo& info);

// An RMS error, rounded up to two digits.
std::string figure_text(double error);

// An expected error, rounded up to three digits. It is an estimate.
std::string expected_text(double error);

// `image 0.059, SSIM 0.978, fit rms 0.00026 in alpha and 4.1e-05 in f0`, without the SSIM if it is unknown.
std::string errors_text(const ConverterInfo& info);

// `mitsuba/ward -> mitsuba/beckmann -> mitsuba/ggx`.
std::string models_text(const ConverterPath& path);

// `SSIM 0.819`, of a path of several steps `SSIM 0.819 in the worst step`; empty if it is unknown.
std::string ssim_text(const ConverterPath& path);

// `cycles-5/ggx will look different from mitsuba/ward (expected error 0.371, SSIM 0.819 in the worst step);
// cycles-5/beckmann would look closer (expected error 0.0545)`, or one of the two; empty if there is neither.
std::string closeness_text(const ConverterPath& path, const Closeness& closeness);

// `cycles-5/beckmann is the closest model of cycles-5 (expected error 0.0545)`: what `--to cycles-5` chose.
std::string closest_text(const std::string& model, double error);

// The ids of the steps.
Json path_json(const ConverterPath& path);
// `looks_different`, `worst_step_ssim` and `closer_model` (null, or the model with its path and expected
// error); all null for a path without steps.
Json closeness_json(const ConverterPath& path, const Closeness& closeness);

}  // namespace remap
