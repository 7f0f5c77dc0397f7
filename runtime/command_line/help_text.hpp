// This file lays out `--help` for every program of the project.
//
// run_app() lays out the help of an app and of its commands. A command only decides in which group its
// options are. All options that are added after
//
//   command->option_group("Output");
//
// appear under the heading "Output:". Groups appear in the order in which their first options were added, so
// add common options first. `--help` omits a group whose name begins with "Rare" (kRareOptions, or "Rare:
// real renderers"). `--help-all` shows it as "Real renderers:", with the options that each excludes. The last
// argument of add_subcommand() is the heading under which the program lists a command.
//
// The layout adds the default, "required", the choices, the bounds and the options of excludes(). So do not
// repeat these in descriptions. Name the value behind the option, as `--fit FILE`; numbers are called N or
// NUMBER automatically. In a description or a footer, a line that begins with a space (an example, a table)
// stays unchanged and must fit into 80 columns. Other lines are wrapped.
#pragma once

#include <string>
#include <string_view>

#include "core/json.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace remap {

// Gives `app` and all its commands the flags --help and --help-all and this layout. Call it after all
// commands and options have been added; run_app() does so.
void lay_out_help(CLI::App& app);

// Returns the help of `app` as values. scripts/update-reference makes manual pages and shell completion from
// it. Call it after lay_out_help().
Json help_table(const CLI::App& app);

// Returns the words that lead to a command: `texremap convert`.
std::string command_words(const CLI::App& command);

// Returns the allowed values of an option as the help prints them: `auto, svr, mlp`, `1 to 4096`, `above 0`.
// Returns an empty text if there is no limit.
std::string allowed_values(const CLI::Option& option);

// Breaks lines of more than 80 columns at blanks. Lines after the first are indented by `indent` columns. The
// first line is assumed to begin at that column, too. Lines that begin with a blank are not broken.
std::string wrapped(std::string_view text, std::size_t indent);

}  // namespace remap
