// gnuplot as a child process: the one place that starts it.
#pragma once

#include <string>

namespace remapc {

// Throws kOutput, naming Debian's package, where gnuplot cannot be started.
void require_gnuplot();

// What gnuplot writes to standard output for `script`. Throws kOutput where it cannot be started or fails,
// with the first line of its complaint.
std::string run_gnuplot(const std::string& script);

}  // namespace remapc
