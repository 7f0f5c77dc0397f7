// This file tests the frame of all programs: exit codes, and answers to mistyped words.
#include "command_line/run_app.hpp"

#include <iostream>
#include <sstream>

#include <catch2/catch.hpp>

#include "command_line/command.hpp"
#include "remap/error.hpp"

using namespace remap;

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
