// What `--version` answers: the version, and what a report of an error should say of the build.
#pragma once

#include <string>

namespace remap {

// The version on the first line; then compiler and kind of build, the converters inside, and the libraries
// with the versions that this build was compiled against. `more_libraries`: those of the program alone,
// "Name 1.2, Name 3".
std::string version_text(const std::string& program, const std::string& more_libraries = "");

}  // namespace remap
