// The help of every program and command is the committed text, of at most 80 columns.
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/process.hpp"
#include "system/files.hpp"

namespace fs = std::filesystem;

namespace {

const fs::path kFolder = fs::path(REMAP_SOURCE_DIR) / "tests/cli/help";

// The commands that the help of a program lists between its usage and its options.
std::vector<std::string> listed_commands(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help.substr(0, help.find("\nHelp:\n")));
  for (std::string line; std::getline(lines, line);)
    if (line.size() > 2 && line.starts_with("  ") && line[2] != ' ')
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

// Compares the output of --help with a committed file.
std::string checked_help(std::vector<std::string> words, const std::string& file) {
  words.push_back("--help");
  const remap::ProcessResult result = remap::run(words);
  INFO("if the new text is right: scripts/update-reference");
  CHECK(result.exit_code == 0);
  CHECK(result.errors.empty());
  CHECK(result.output == remap::read_file(kFolder / file));
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) {
    INFO(line);
    CHECK(line.size() <= 80);
  }
  return result.output;
}

}  // namespace

TEST_CASE("help: every program and command prints the committed text, of at most 80 columns", "[slow]") {
  const std::vector<std::pair<std::string, std::string>> programs = {
      {"remapc", REMAPC_PROGRAM}, {"texremap", REMAP_TEXREMAP}, {"remap-study", REMAP_STUDY}};
  std::set<std::string> known;
  for (const auto& [name, program] : programs) {
    known.insert(name + ".txt");
    const std::vector<std::string> commands = listed_commands(checked_help({program}, name + ".txt"));
    REQUIRE(commands.size() >= 3);
    for (const std::string& command : commands) {
      INFO(name << " " << command);
      known.insert(name + "-" + command + ".txt");
      const std::string help = checked_help({program, command}, name + "-" + command + ".txt");
      CHECK_THAT(help, Catch::Contains("Example:\n  " + name + " " + command));
    }
  }
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    INFO(entry.path());
    CHECK(known.contains(entry.path().filename().string()));
  }
}

TEST_CASE("help: --help-all shows the options that --help leaves out") {
  const std::string some = remap::run({REMAPC_PROGRAM, "sweep", "--help"}).output,
                    all = remap::run({REMAPC_PROGRAM, "sweep", "--help-all"}).output;
  CHECK_THAT(some,
             Catch::Contains("See remapc sweep --help-all for") && !Catch::Contains("--worker-timeout"));
  CHECK_THAT(all, Catch::Contains("--worker-timeout") && !Catch::Contains("See remapc sweep"));
}
