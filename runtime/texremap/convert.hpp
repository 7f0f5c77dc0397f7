// The work of `texremap convert`.
#pragma once

#include "texremap/convert_options.hpp"

namespace remap {

// Converts what the options name, and prints what was done. Throws after a conversion of which a set failed.
void convert(ConvertOptions options);

// Everything that convert() checks before it opens the first image: options, converter, and of a folder the
// names of all files. Throws as convert().
void check_conversion(ConvertOptions options);

}  // namespace remap
