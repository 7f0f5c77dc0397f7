#include "command_line/run_app.hpp"

#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "command_line/command.hpp"
#include "command_line/help_text.hpp"
#include "command_line/usage_error.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

int parse_and_run(CLI::App& app, int argc, const char* const* argv) {
  lay_out_help(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answer) {
    app.exit(answer);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::kUsage, usage_error_text(app, error));
  }
  std::cout.flush();
  if (!std::cout) throw Error(ErrorKind::kOutput, "standard output: cannot be written");
  return 0;
}

}  // namespace

int run_app(Command& command, int argc, const char* const* argv) noexcept {
  // Without this, the signal would end the program where a file exceeds the process's size limit. With it,
  // the write fails and is reported like any other.
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App& app = command.app();
  try {
    try {
      return parse_and_run(app, argc, argv);
    } catch (const Error& error) {
      print_message(app.get_name(), error.what());
      return exit_code(error.kind());
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

void print_message(const std::string& program, const std::string& message) {
  std::string line = program + ": " + message;
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::cerr << line << std::endl;
}

bool terminal_watches_errors() noexcept { return ::isatty(STDERR_FILENO) == 1; }

}  // namespace remap
