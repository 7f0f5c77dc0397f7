// `texremap convert` of glTF files: a file in, the same file with converted materials out.
#pragma once

#include "texremap/convert_options.hpp"

namespace remap {

// Whether DIR is a glTF file, which then is converted. Where it is not, throws kUsage for options that only
// assets have. Throws as the conversion of sets does: after the last file, where one failed.
bool convert_as_assets(const ConvertOptions& options);

}  // namespace remap
