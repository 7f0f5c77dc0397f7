// This file is the frame of every program. It parses the command line, runs the chosen command, and turns
// each failure into one line on standard error and an exit code.
#pragma once

#include <string>
#include <vector>

namespace remap {

class Command;

// Lays out the help of `command` (help_text.hpp), parses the arguments, and runs the command. Commands work
// in callbacks and throw Error. Returns the exit code: 0 for success, 1 for failure, 2 for wrong usage. A
// failure is printed as `program: place: what is wrong (what to do)`, where `program` is the name of
// `command`. For an unknown option or command, the message suggests the closest known name. If standard
// output cannot be flushed, the run has failed. Never throws.
int run_app(Command& command, int argc, const char* const* argv) noexcept;

// Reads `words` as the arguments of `command`, without its name, and runs it. Throws kUsage for words that it
// does not accept; help is printed.
void run_words(Command& command, std::vector<std::string> words);

// Prints one line to standard error: `program: message`. Line breaks in the message become spaces. Other
// control characters become escapes (plain_text.hpp). An endless message is cut.
void print_message(const std::string& program, const std::string& message);

// Returns true if standard error is a terminal.
bool terminal_watches_errors() noexcept;

// Returns the version on the first line. Then follow compiler and kind of build, the included converters, and
// the libraries with the versions that this build was compiled against. `more_libraries` are used only by
// this program: "Name 1.2, Name 3".
std::string version_text(const std::string& program, const std::string& more_libraries = "");

}  // namespace remap
