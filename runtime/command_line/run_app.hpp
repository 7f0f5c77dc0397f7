// The frame of both programs: parses the command line, runs the chosen command and turns every failure into
// one line on standard error and an exit code.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace remap {

// Parses the arguments with `app`, whose commands do their work in CLI11 callbacks and throw Error, and
// returns the exit code: 0 done, 1 failed, 2 wrong usage. Failures are printed as `program: place: what; what
// was expected`, where `program` is the name of `app`; unknown options and commands are answered with the
// nearest known name. Never throws. Standard output is flushed, and a failure to do so is a failure.
int run_app(CLI::App& app, int argc, const char* const* argv) noexcept;

// One line on standard error: `program: message`. A line break inside becomes a space.
void print_message(const std::string& program, const std::string& message);

// Whether standard error is a terminal, that is whether a person watches it.
bool terminal_watches_errors() noexcept;

}  // namespace remap
