// The work of `texremap convert`.
#pragma once

#include "texremap/options/convert_options.hpp"

namespace remap {

// Converts what the options name, and prints what was done. Throws after a conversion of which a set or an
// asset failed.
void convert(ConvertOptions options);

}  // namespace remap
