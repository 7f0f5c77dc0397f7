// The built-in naming habits: the text of naming.json, compiled in so that no file is needed at run time.
#pragma once

#include <string_view>

namespace remap {

extern const std::string_view kNamingText;

}  // namespace remap
