// This file does the work of `texremap convert`.
#pragma once

#include "texremap/options/convert_options.hpp"

namespace remap {

// Converts what the options name, and prints the results. Throws afterwards if a set or an asset failed.
void convert(ConvertOptions options);

}  // namespace remap
