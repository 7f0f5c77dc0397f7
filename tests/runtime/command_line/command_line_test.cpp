// This file tests what both programs share: the layout of --help, exit codes, answers to mistyped words,
// and signals that ask a program to stop, each in a separate process.
#include <csignal>
#include <functional>
#include <iostream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <catch2/catch.hpp>

#include "command_line/command.hpp"
#include "command_line/help_text.hpp"
#include "command_line/progress.hpp"
#include "command_line/run_app.hpp"
#include "remap/error.hpp"

using namespace remap;

namespace {

// Returns what `read` makes of `tool bake`, a command with options of all kinds.
template <typename Read>
auto of_bake(const Read& read) {
  Command app("A tool.", "tool");
  Command* bake = app.add_subcommand("bake", "Bake a map");
  std::string input, model = "svr", stroke, folder = "fits";
  std::vector<std::size_t> layers = {16, 16};
  bool exact = false, quiet = false;
  bake->add_option("table", input, "The table to read")->required();
  bake->option_group("Fit");
  bake->add_option("--model", model, "How to fit it, in a description that takes more than a single line")
      ->one_of({"auto", "svr"});
  Option* sizes = bake->add_option("--layers", layers, "Units of each layer")
                      ->delimiter(',')
                      ->range(std::size_t{1}, std::size_t{4096});
  bake->add_flag("--exact", exact, "As it was fitted")->excludes(sizes);
  bake->option_group("Output");
  bake->add_option("-o,--output FOLDER", folder, "Folder for the fit");
  bake->add_option("--mask SOURCE_MASK TEMPLATE_MASK[:CHANNEL]", stroke, "Two masks");
  bake->option_group(kRareOptions);
  bake->add_flag("--quiet", quiet, "Print nothing");
  bake->footer("Example:\n  tool bake table.csv");
  lay_out_help(app.app());
  return read(bake->app());
}

// Returns the help as --help or --help-all shows it.
std::string help_of_bake(CLI::AppFormatMode mode) {
  return of_bake([&](const CLI::App& app) { return app.help("tool", mode); });
}

}  // namespace

TEST_CASE("help_text: options stand in their groups, with what CLI11 knows of them") {
  CHECK(help_of_bake(CLI::AppFormatMode::Normal) ==
        "Bake a map\n"
        "\n"
        "Usage: tool bake table [options]\n"
        "\n"
        "Arguments:\n"
        "  table                   The table to read (required)\n"
        "\n"
        "Fit:\n"
        "  --model NAME            How to fit it, in a description that takes more than a\n"
        "                          single line (one of auto, svr; default: svr)\n"
        "  --layers N              Units of each layer (1 to 4096; default: 16,16)\n"
        "  --exact                 As it was fitted\n"
        "\n"
        "Output:\n"
        "  -o, --output FOLDER     Folder for the fit (default: fits)\n"
        "  --mask SOURCE_MASK TEMPLATE_MASK[:CHANNEL]\n"
        "                          Two masks\n"
        "\n"
        "Help:\n"
        "  -h, --help              Show this help\n"
        "  --help-all              Show all options\n"
        "\n"
        "Example:\n"
        "  tool bake table.csv\n"
        "\n"
        "See tool bake --help-all for 1 more option.\n");
}

TEST_CASE("help_text: --help-all shows rare options") {
  const std::string help = help_of_bake(CLI::AppFormatMode::All);
  CHECK_THAT(help, Catch::Contains("\nRare options:\n  --quiet                 Print nothing\n"));
  CHECK_THAT(help, !Catch::Contains("--help-all for"));
}

TEST_CASE("help_text: commands stand in their groups") {
  Command app("A tool.", "tool");
  app.add_subcommand("bake", "Bake a map", "Make");
  app.add_subcommand("show", "Show a map", "Look");
  app.add_subcommand("burn", "Burn a map", "Make");
  lay_out_help(app.app());
  CHECK(app.app().help() ==
        "A tool.\n"
        "\n"
        "Usage: tool COMMAND [options]\n"
        "\n"
        "Make:\n"
        "  bake                    Bake a map\n"
        "  burn                    Burn a map\n"
        "\n"
        "Look:\n"
        "  show                    Show a map\n"
        "\n"
        "Help:\n"
        "  -h, --help              Show this help\n");
}

TEST_CASE("help_text: long lines break at blanks, indented lines stay") {
  const std::string words =
      "0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123";
  CHECK(wrapped(words, 0) ==
        "0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789\n0123");
  CHECK(wrapped("a\n\n " + words + "\nb", 2) == "a\n\n   " + words + "\n  b");
  CHECK(wrapped(std::string(90, 'x') + " y", 4) == std::string(90, 'x') + "\n    y");
}

TEST_CASE("help_text: the table says what the help says") {
  const Json table = of_bake([](const CLI::App& app) { return help_table(app); });
  CHECK(*table.find("name")->text() == "tool bake");
  CHECK(*table.find("usage")->text() == "Usage: tool bake table [options]");
  CHECK(*table.find("arguments")->entries()->front().find("names")->text() == "table");
  const Json& fit = table.find("groups")->entries()->front();
  CHECK(*fit.find("group")->text() == "Fit");
  const Json& model = fit.find("options")->entries()->front();
  CHECK(*model.find("names")->text() == "--model");
  CHECK(*model.find("choices")->text() == "auto, svr");
}

TEST_CASE("help_text: excluded options stand in the order of their names, wherever they lie in memory") {
  for (const bool narrow_first : {true, false}) {
    Command app("A tool.", "tool");
    bool exact = false, narrow = false, wide = false, plain = false;
    Option* b =
        narrow_first ? app.add_flag("--narrow", narrow, "Narrow") : app.add_flag("--wide", wide, "Wide");
    Option* a = app.add_flag("--plain", plain, "Plain");
    Option* c =
        narrow_first ? app.add_flag("--wide", wide, "Wide") : app.add_flag("--narrow", narrow, "Narrow");
    app.add_flag("--exact", exact, "Exact")->excludes(c)->excludes(a)->excludes(b);
    lay_out_help(app.app());
    const std::string text = app.app().help("tool", CLI::AppFormatMode::All);
    CHECK_THAT(text, Catch::Matchers::Contains("Exact (not with --narrow; not with --plain; not with\n"));
  }
}

namespace {

struct Answer {
  int code;
  std::string errors;
};

// Runs an app `tool` with the commands `bake` (--size N required, --shape) and `show`.
Answer run_tool(
    std::vector<const char*> words, const std::function<void()>& work = [] {}) {
  Command app("A tool.", "tool");
  app.require_subcommand(1);
  Command* bake = app.add_subcommand("bake");
  int size = 0;
  std::string shape;
  bake->add_option("--size", size)->required();
  bake->add_option("--shape", shape);
  bake->callback(work);
  app.add_subcommand("show");
  words.insert(words.begin(), "tool");
  std::ostringstream errors, output;
  std::streambuf* const kept_errors = std::cerr.rdbuf(errors.rdbuf());
  std::streambuf* const kept_output = std::cout.rdbuf(output.rdbuf());
  const int code = run_app(app, static_cast<int>(words.size()), words.data());
  std::cerr.rdbuf(kept_errors);
  std::cout.rdbuf(kept_output);
  return {code, errors.str()};
}

}  // namespace

TEST_CASE("run_app: a command that returns is exit code 0") {
  const Answer answer = run_tool({"bake", "--size", "3"});
  CHECK(answer.code == 0);
  CHECK(answer.errors.empty());
  CHECK(run_tool({"--help"}).code == 0);
  CHECK(run_tool({"bake", "--help"}).code == 0);
}

TEST_CASE("run_app: mistyped words are answered with the nearest") {
  CHECK(run_tool({"bake", "--sise", "3"}).errors == "tool: unknown option --sise (did you mean --size?)\n");
  CHECK(run_tool({"bake", "--size=3", "--shpae=x"}).errors ==
        "tool: unknown option --shpae (did you mean --shape?)\n");
  CHECK(run_tool({"baek"}).errors == "tool: unknown command 'baek' (did you mean bake?)\n");
  CHECK(run_tool({"bake", "--sise", "3"}).code == 2);
  CHECK(run_tool({"baek"}).code == 2);
}

TEST_CASE("run_app: what is missing or too much is named") {
  CHECK(run_tool({}).errors == "tool: no command given (try --help)\n");
  CHECK(run_tool({"bake"}).errors == "tool: --size is required (see tool bake --help)\n");
  CHECK(run_tool({"bake", "--size"}).errors == "tool: --size: value missing (see tool bake --help)\n");
  CHECK(run_tool({"bake", "--size", "big"}).errors ==
        "tool: --size: invalid value 'big' (see tool bake --help)\n");
  CHECK(run_tool({"bake", "--size", "3", "more"}).errors ==
        "tool: unexpected argument 'more' (see tool bake --help)\n");
  CHECK(run_tool({"bake"}).code == 2);
}

TEST_CASE("run_app: a failing command is one line and the exit code of its kind") {
  const auto failing = [](ErrorKind kind) {
    return run_tool({"bake", "--size", "3"}, [kind] { throw Error(kind, "x: is\nbad; expected good"); });
  };
  CHECK(failing(ErrorKind::kInput).code == 1);
  CHECK(failing(ErrorKind::kInterrupted).code == 1);
  CHECK(failing(ErrorKind::kUsage).code == 2);
  CHECK(failing(ErrorKind::kInput).errors == "tool: x: is bad; expected good\n");
  const Answer other = run_tool({"bake", "--size", "3"}, [] { throw std::runtime_error("odd"); });
  CHECK(other.code == 1);
  CHECK(other.errors == "tool: unexpected failure: odd\n");
}

namespace {

// Runs `work` in a child process. Returns its exit code, or minus the signal that ended it.
int end_of(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    // Catch2 installs handlers here, and the test may run under nohup.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
    ::_exit(work());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

TEST_CASE("interruption: the first signal sets the flag, the second ends the process") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto once = [&] {
      watch_interruptions();
      if (interruption()) return 1;
      std::raise(signal);
      return interruption() ? 0 : 2;
    };
    CHECK(end_of(once) == 0);
    CHECK(end_of([&] {
            once();
            watch_interruptions();  // a command may call it again when it starts another part of its work
            std::raise(signal);
            return 0;
          }) == -signal);
  }
}

TEST_CASE("interruption: whoever writes to a pipe that nobody reads can still clean up") {
  CHECK(end_of([] {
          watch_interruptions();
          int ends[2];
          if (::pipe(ends) != 0) return 1;
          ::close(ends[0]);
          for (int i = 0; i < 3; ++i)
            if (::write(ends[1], "x", 1) == 1) return 2;
          return interruption() ? 0 : 3;
        }) == 0);
}

TEST_CASE("interruption: a program under nohup goes on") {
  CHECK(end_of([] {
          std::signal(SIGHUP, SIG_IGN);
          watch_interruptions();
          std::raise(SIGHUP);
          return interruption() ? 1 : 0;
        }) == 0);
}
