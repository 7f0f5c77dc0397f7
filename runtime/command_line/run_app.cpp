#include "command_line/run_app.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>

#include "command_line/command.hpp"
#include "command_line/help_text.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"
#include "core/system.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// Messages may be this long, because some list many names to choose from.
constexpr std::size_t kLongestLine = 8000;

// Returns the command that the arguments chose, on the lowest level of subcommands.
const CLI::App& chosen_command(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return *command;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option :
       command.get_options([](const CLI::Option* known) { return !known->get_group().empty(); }))
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string see_help(const CLI::App& command) { return " (see " + command_words(command) + " --help)"; }

std::string did_you_mean(const std::string& name, const std::vector<std::string>& known,
                         const CLI::App& command) {
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? see_help(command) : " (did you mean " + nearest + "?)";
}

bool ends_with_and_drop(std::string& text, const std::string& ending) {
  if (!text.ends_with(ending)) return false;
  text.erase(text.size() - ending.size());
  return true;
}

// Returns the message for arguments that no option accepts.
std::string extra_text(const CLI::App& command, const std::vector<std::string>& extras) {
  const auto is_option = [](const std::string& word) { return word.size() > 1 && word.front() == '-'; };
  const std::vector<std::string> commands = command_names(command);
  if (!commands.empty() && !is_option(extras.front()))
    return "unknown command '" + extras.front() + "'" + did_you_mean(extras.front(), commands, command);
  const auto option = std::ranges::find_if(extras, is_option);
  if (option != extras.end()) {
    const std::string name = option->substr(0, option->find('='));
    return "unknown option " + name + did_you_mean(name, option_names(command), command);
  }
  return "unexpected argument '" + extras.front() + "'" + see_help(command);
}

// Returns `--model: unknown value 'x' (choose auto, svr)` for a value that a check of the option refused.
// CLI11 prefixes the message with the option's name.
std::string refused_value_text(const CLI::App& command, const std::string& what) {
  const std::size_t colon = what.find(": ");
  const std::string name = what.substr(0, colon);
  const CLI::Option* option = command.get_option_no_throw(name);
  if (colon == std::string::npos || option == nullptr) return what + see_help(command);
  const std::string allowed = allowed_values(*option), choice = " not in {";
  if (const std::size_t end = what.find(choice); end != std::string::npos)
    return name + ": unknown value '" + what.substr(colon + 2, end - colon - 2) + "' (choose " + allowed +
           ")";
  const std::string value = ": Value ", range = " not in range ";
  const std::size_t start = what.find(value), end = what.find(range);
  if (allowed.empty() || start == std::string::npos || end == std::string::npos)
    return what + see_help(command);
  return name + ": invalid value '" + what.substr(start + value.size(), end - start - value.size()) +
         "' (allowed: " + allowed + ")";
}

// Returns the message for a command line that `app` refused with `error`. It has the mistake and the fix,
// such as `unknown option --form (did you mean --from?)`.
std::string usage_error_text(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = chosen_command(app);
  // Report a mistyped option first, because it is the more likely cause. With `--form a`, --from is missing,
  // too.
  if (const std::vector<std::string> extras = app.remaining(true); !extras.empty())
    return extra_text(command, extras);
  std::string what = error.what();
  if (error.get_name() == "RequiredError" && what == "A subcommand is required")
    return "no command given (try --help)";
  if (error.get_name() == "ValidationError") return refused_value_text(command, what);
  if (error.get_name() == "ArgumentMismatch" && ends_with_and_drop(what, " missing")) {
    const std::size_t colon = what.find(": "), end = what.find(" required ", colon);
    const std::string name = what.substr(0, colon), count = what.substr(colon + 2, end - colon - 2);
    if (count == "1") return name + ": value missing" + see_help(command);
    return name + ": expects " + count + " values, " + what.substr(end + std::string(" required ").size());
  }
  const std::string at_most = ": At Most 1 required but received ";
  if (const std::size_t at = what.find(at_most); at != std::string::npos) {
    const std::string count = what.substr(at + at_most.size());
    return what.substr(0, at) + ": given " + (count == "2" ? "twice" : count + " times") + " (give it once)";
  }
  const std::string conversion = "Could not convert: ", excludes = " excludes ";
  if (const std::size_t equals = what.find(" = ");
      what.starts_with(conversion) && equals != std::string::npos)
    return what.substr(conversion.size(), equals - conversion.size()) + ": invalid value '" +
           what.substr(equals + 3) + "'" + see_help(command);
  if (const std::size_t at = what.find(excludes);
      error.get_name() == "ExcludesError" && at != std::string::npos)
    return what.substr(0, at) + " cannot be used with " + what.substr(at + excludes.size()) +
           " (remove one of the two)";
  return what + see_help(command);
}

// Returns the words in reverse order, which CLI11 expects. `PROGRAM help COMMAND` and `PROGRAM version`
// become options.
std::vector<std::string> words_of(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    words.emplace_back("--help");
  } else if (words.size() == 1 && words.front() == "version") {
    words.front() = "--version";
  }
  std::ranges::reverse(words);
  return words;
}

// Runs `words` in reverse order, as CLI11 reads them.
void run_reversed(CLI::App& app, std::vector<std::string> words) {
  try {
    app.parse(std::move(words));
  } catch (const CLI::Success& answer) {
    app.exit(answer);
  } catch (const CLI::ParseError& error) {
    throw usage_error(usage_error_text(app, error));
  }
}

int parse_and_run(CLI::App& app, int argc, const char* const* argv) {
  lay_out_help(app);
  if (argc == 2 && argv[1] == std::string_view("--help-table"))
    std::cout << help_table(app).dump(1) << '\n';
  else
    run_reversed(app, words_of(argc, argv));
  std::cout.flush();
  // This happens if the program that reads the output, such as `head`, has read enough. No call since then
  // could have changed errno.
  if (!std::cout && errno == EPIPE) return 1;
  if (!std::cout)
    throw output_error("standard output: cannot be written" +
                       (errno == 0 ? std::string() : ": " + std::string(std::strerror(errno))));
  return 0;
}

}  // namespace

int run_app(Command& command, int argc, const char* const* argv) noexcept {
  fail_at_limit_of_file_size();
  CLI::App& app = command.app();
  try {
    try {
      return parse_and_run(app, argc, argv);
    } catch (const Error& error) {
      print_message(app.get_name(), error.what());
      return exit_code(error);
    } catch (const std::bad_alloc&) {
      print_message(app.get_name(), "out of memory");
    } catch (const std::exception& error) {
      print_message(app.get_name(), std::string("unexpected failure: ") + error.what());
    }
  } catch (...) {
    // Printing the message failed, so it cannot be reported.
  }
  return 1;
}

void run_words(Command& command, std::vector<std::string> words) {
  std::ranges::reverse(words);
  run_reversed(command.app(), std::move(words));
}

void print_message(const std::string& program, const std::string& message) {
  std::string line = program + ": " + message;
  std::ranges::replace(line, '\n', ' ');
  std::cerr << plain(line, kLongestLine) << std::endl;
}

bool terminal_watches_errors() noexcept { return ::isatty(STDERR_FILENO) == 1; }

}  // namespace remap
