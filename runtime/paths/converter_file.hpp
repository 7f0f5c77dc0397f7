// Reads the converters in fit files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include "converter/converter_data.hpp"
#include "remap/warp.hpp"

namespace remap {

// A fit between workflows: a formula that texremap has, or a network, which it does not run.
struct UnusedFit {};

using FittedConverter = std::variant<ConverterData, WarpMapFit, UnusedFit>;

// The converter in a fit file. Messages begin with `context`, a file name. Throws kInput for anything else
// than a fit file, and for a fit without a converter.
FittedConverter fitted_converter_from_json(std::string_view text, const std::string& context);

// The same for a file. Throws kInput if it cannot be read.
FittedConverter load_fitted_converter(const std::filesystem::path& path);

}  // namespace remap
