// This file reads the converters in fit files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include "converter/converter_data.hpp"
#include "remap/warp.hpp"

namespace remap {

// An UnusedFit is a fit between workflows that texremap does not run. It is a network, or a formula that
// texremap has already.
using UnusedFit = std::monostate;

using FittedConverter = std::variant<ConverterData, WarpMapFit, UnusedFit>;

// Reads the converter in a fit file. Messages begin with `context`, a file name. Throws kInput for any other
// file, and for a fit without a converter.
FittedConverter fitted_converter_from_json(std::string_view text, const std::string& context);

// Returns true for the text of a converters.json, which is not a fit.
bool is_converter_list(std::string_view text);

// Reads the converter in the fit file `path`. Throws kInput if it cannot be read.
FittedConverter load_fitted_converter(const std::filesystem::path& path);

}  // namespace remap
