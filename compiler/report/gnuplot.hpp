// Runs gnuplot as a child process.
#pragma once

#include <string>

namespace remapc {

// Throws kOutput with the name of Debian's package if gnuplot cannot be started.
void require_gnuplot();

// Returns the standard output of gnuplot for `script`. Throws kOutput if gnuplot cannot be started or fails,
// with the first line of its error message.
std::string run_gnuplot(const std::string& script);

}  // namespace remapc
