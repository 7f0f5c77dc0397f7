// Messages for command lines that cannot be parsed.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace remap {

// The message for a command line that `app` refused with `error`: what is wrong and what to do, as `unknown
// option
// --form (did you mean --from?)` or `--output is required (see texremap convert --help)`.
std::string usage_error_text(const CLI::App& app, const CLI::ParseError& error);

}  // namespace remap
