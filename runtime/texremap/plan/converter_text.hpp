// Converters and paths as text and as JSON, for all commands.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/json.hpp"
#include "remap/path.hpp"

namespace remap {

// Nobody sees differences below this fraction of the display's range or of the texels, so only --verbose
// reports them.
inline constexpr double kVisible = 0.01;

// Pictures differ by this times the residual of metal-rough, on the mean.
inline constexpr double kPictureOfResidual = 0.42;

// `alpha 0.01 to 1`.
std::string range_text(std::string_view name, const Range& range);

// `alpha 0.01 to 1, specular 0 to 0.5`: the domain of a converter.
std::string domain_text(const ConverterInfo& info);

// `pictures differ by 8.0 %, with copied numbers by 14.1 %`, an estimate `pictures differ by about 8.4 %`,
// `both models have the same lobe, so that numbers are copied`, `nobody has compared pictures`. `path` has
// steps.
std::string difference_text(const ConverterPath& path);

// `mitsuba/ward -> mitsuba/beckmann -> mitsuba/ggx`.
std::string models_text(const ConverterPath& path);

// `mitsuba/ward to cycles-5/ggx: pictures differ by about 8.2 %; cycles-5/beckmann matches the highlight more
// closely`, or one of the two, or that numbers are copied. Else empty: people see no difference below 1 %.
std::string note_text(const ConverterPath& path, const std::optional<ConverterPath>& closer);

// `cycles-5/beckmann matches the highlight more closely`.
std::string closer_text(const ConverterPath& closer);

// `cycles-5/beckmann is the closest model of cycles-5`: what `--to cycles-5` chose.
std::string closest_text(const std::string& model);

// The ids of the steps.
Json path_json(const ConverterPath& path);
// `pictures` (`converted` and `copied`, in per cent, `is_estimate`; null where nobody has compared them),
// `same_lobe` (whether numbers are copied) and `closer_model` (null, or the model with its path and expected
// error).
Json pictures_json(const ConverterPath& path, const std::optional<ConverterPath>& closer);

}  // namespace remap
