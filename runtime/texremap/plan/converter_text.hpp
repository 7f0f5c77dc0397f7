// This file writes converters and paths as text and as JSON, for all commands. A ConversionNote
// records what results depend on, except the inputs, so that a later run can compare it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json.hpp"
#include "remap/conversion.hpp"
#include "remap/converter.hpp"

namespace remap {

// Nobody sees differences below this fraction of the display's range or of the texels, so only --verbose
// reports them.
inline constexpr double kVisible = 0.01;

// Pictures differ on average by this factor times the residual of metal-rough.
inline constexpr double kPictureOfResidual = 0.42;

// Returns a text such as `alpha 0.01 to 1`.
std::string range_text(std::string_view name, const Range& range);

// Returns the domain of a converter, such as `alpha 0.01 to 1, specular 0 to 0.5`.
std::string domain_text(const ConverterInfo& info);

// Returns `rendered pictures differ by 8.0 % (14.1 % with copied numbers)`, or for an estimate `rendered
// pictures differ by about 8.4 %`. Other texts are `both models have the same lobe, so that numbers are
// copied` and `pictures were never compared`. `path` must have steps.
std::string difference_text(const ConverterPath& path);

// Returns `mitsuba/ward -> mitsuba/beckmann -> mitsuba/ggx`.
std::string models_text(const ConverterPath& path);

// Returns `mitsuba/ward to cycles-5/ggx: rendered pictures differ by about 8.2 %; cycles-5/beckmann matches
// the highlight more closely`, or one of these parts, or that numbers are copied. Returns an empty text below
// 1 %, which nobody sees.
std::string note_text(const ConverterPath& path, const std::optional<ConverterPath>& closer);

// Returns `cycles-5/beckmann matches the highlight more closely`.
std::string closer_text(const ConverterPath& closer);

// Returns `cycles-5/beckmann is the closest model of cycles-5`, which explains the choice of `--to cycles-5`.
std::string closest_text(const std::string& model);

// Returns a text such as `diffuse plain, dielectric F0 0.04`.
std::string conventions_text(const WorkflowEnd& end);

// Returns the text that results store as `remap:converter`: the ids of steps, and a workflow's formula.
std::string converter_ids(const BuiltConversion& chosen);

// Returns the ids of the steps.
Json path_json(const ConverterPath& path);
// Returns `pictures` (`converted` and `copied`, in per cent, `is_estimate`; null if nobody has compared
// them), `same_lobe` (true if numbers are copied) and `closer_model` (null, or the model with its path and
// expected error).
Json pictures_json(const ConverterPath& path, const std::optional<ConverterPath>& closer);

struct ConversionNote {
  std::string source, target;  // names of models
  std::string hash;            // hash of everything, including the converter's results
  // If two notes differ, a message shows which of these differ: converter, options, version.
  std::vector<std::pair<std::string, std::string>> details;
};

// Makes a note. Its hash covers the converter's results for texels all over its domain, so it notices changed
// numbers and changed code. `ids` are the ids of the steps, or empty for assets. `options` are the options
// that change results.
ConversionNote conversion_note(const std::string& source, const std::string& target, const std::string& ids,
                               const Converter& converter, const std::string& options);

}  // namespace remap
