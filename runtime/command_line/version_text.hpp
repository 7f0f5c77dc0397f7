// This file makes the text of `--version`, which has the version and facts about the build for error reports.
#pragma once

#include <string>

namespace remap {

// Returns the version on the first line. Then follow compiler and kind of build, the included converters, and
// the libraries with the versions that this build was compiled against. `more_libraries` are used only by
// this program: "Name 1.2, Name 3".
std::string version_text(const std::string& program, const std::string& more_libraries = "");

}  // namespace remap
