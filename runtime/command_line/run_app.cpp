#include "command_line/run_app.hpp"

#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>

#include "remap/error.hpp"
#include "text/nearest_name.hpp"

namespace remap {
namespace {

// The command that the arguments chose, as deep as they went.
const CLI::App& chosen_command(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return *command;
}

// `texremap convert`: the words that lead to a command.
std::string command_words(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : command_words(*parent) + " " + command.get_name();
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string joined(const std::vector<std::string>& names, const std::string& separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
  return text;
}

bool ends_with_and_drop(std::string& text, const std::string& ending) {
  if (!text.ends_with(ending)) return false;
  text.erase(text.size() - ending.size());
  return true;
}

// What is wrong with an argument that no option took. CLI11 hands them over only as a list.
std::string describe_extra(const CLI::App& app, const std::vector<std::string>& extras) {
  const CLI::App& command = chosen_command(app);
  const auto is_option = [](const std::string& word) { return word.size() > 1 && word.front() == '-'; };
  const auto option = std::find_if(extras.begin(), extras.end(), is_option);
  if (option != extras.end()) {
    const std::string name = option->substr(0, option->find('='));
    return name + ": is no option of " + command_words(command) + suggestion(name, option_names(command));
  }
  const std::vector<std::string> commands = command_names(command);
  if (!commands.empty())
    return extras.front() + ": is no command of " + command_words(command) +
           suggestion(extras.front(), commands);
  return extras.front() + ": is one argument too many; see " + command_words(command) + " --help";
}

std::string describe(const CLI::App& app, const CLI::ParseError& error) {
  // Whatever CLI11 complained of, a mistyped option is the likelier reason: `--form a` is a `--from` missing.
  if (const std::vector<std::string> extras = app.remaining(true); !extras.empty())
    return describe_extra(app, extras);
  const CLI::App& command = chosen_command(app);
  std::string what = error.what();
  const std::string see = "; see " + command_words(command) + " --help";
  if (error.get_name() == "RequiredError") {
    if (what == "A subcommand is required")
      return "command: is missing; expected one of " + joined(command_names(command), ", ");
    if (ends_with_and_drop(what, " is required")) return what + ": is missing" + see;
  }
  if (error.get_name() == "ArgumentMismatch" && ends_with_and_drop(what, " missing"))
    return what.substr(0, what.find(':')) + ": has no value" + see;
  if (error.get_name() == "ConversionError" && what.starts_with("Could not convert: ")) {
    what.erase(0, std::string("Could not convert: ").size());
    const std::size_t equals = what.find(" = ");
    if (equals != std::string::npos)
      return what.substr(0, equals) + ": is " + what.substr(equals + 3) + ", which is no value for it" + see;
  }
  return what + see;
}

int parse_and_run(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answer) {
    app.exit(answer);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::kUsage, describe(app, error));
  }
  std::cout.flush();
  if (!std::cout) throw Error(ErrorKind::kOutput, "standard output: cannot be written");
  return 0;
}

}  // namespace

int run_app(CLI::App& app, int argc, const char* const* argv) noexcept {
  // A file that grows beyond the limit of the process is then a failing write, which is reported as any
  // other.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    try {
      return parse_and_run(app, argc, argv);
    } catch (const Error& error) {
      print_message(app.get_name(), error.what());
      return exit_code(error.kind());
    } catch (const std::bad_alloc&) {
      print_message(app.get_name(), "memory: there is not enough");
    } catch (const std::exception& error) {
      print_message(app.get_name(), std::string("unexpected failure: ") + error.what());
    }
  } catch (...) {
    // Nothing is left to tell it with.
  }
  return 1;
}

void print_message(const std::string& program, const std::string& message) {
  std::string line = program + ": " + message;
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::cerr << line << std::endl;
}

bool terminal_watches_errors() noexcept { return ::isatty(STDERR_FILENO) == 1; }

}  // namespace remap
