// Typical mistakes on the command line: each has the committed exit code and message.
#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include "support/process.hpp"
#include "support/temporary_folder.hpp"
#include "system/files.hpp"

namespace fs = std::filesystem;

namespace {

const fs::path kFolder = fs::path(REMAP_SOURCE_DIR) / "tests/cli/errors";
const std::map<std::string, std::string> kPrograms = {{"remapc", REMAPC_PROGRAM},
                                                      {"texremap", REMAP_TEXREMAP}};

// Runs `program arguments` in a folder of its own with copies of the inputs.
remap::ProcessResult run_command(const std::string& command) {
  const remap::TemporaryFolder folder;
  fs::copy(kFolder / "inputs", folder.path(), fs::copy_options::recursive);
  const std::size_t blank = std::min(command.find(' '), command.size());
  const std::string program = kPrograms.at(command.substr(0, blank));
  return remap::run(
      {"/bin/sh", "-c",
       "cd '" + folder.path().string() + "' && exec '" + program + "'" + command.substr(blank)});
}

// Checks the cases of a file: `$ command`, then `exit code, blank, message`. Returns their number.
int check_cases(const std::string& file) {
  std::istringstream lines(remap::read_file(kFolder / file));
  int count = 0;
  for (std::string command, expected; std::getline(lines, command) && std::getline(lines, expected);
       ++count) {
    INFO(command << "\nif the new message is right: scripts/update-reference");
    REQUIRE(command.starts_with("$ "));
    const remap::ProcessResult result = run_command(command.substr(2));
    CHECK(result.exit_code != 0);
    CHECK(std::to_string(result.exit_code) + " " + result.last_error() == expected);
    CHECK(result.output.empty());
  }
  return count;
}

}  // namespace

TEST_CASE("errors: typical mistakes with remapc are answered as committed", "[slow]") {
  CHECK(check_cases("remapc.txt") >= 15);
}

TEST_CASE("errors: typical mistakes with texremap are answered as committed", "[slow]") {
  CHECK(check_cases("texremap.txt") >= 15);
}
