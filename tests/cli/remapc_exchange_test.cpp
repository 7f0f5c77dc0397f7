// Lookup tables for other tools, and what `list` says of a folder without fits.
#include <filesystem>
#include <sstream>

#include <catch2/catch.hpp>

#include "cli/remapc_session.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> data_lines(const std::string& file) {
  std::vector<std::string> lines;
  std::istringstream stream(read_file(file));
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with("#")) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("remapc export: a parametric fit is a table over its width", "[slow]") {
  const Session session;
  session.write("t.csv", made_table(8, 3));
  auto fit = session.fit("t.csv");
  fit.insert(fit.end(), {"--form", "paper"});
  REQUIRE(session.remapc(fit).exit_code == 0);
  const std::string table = session.path("lut/one.csv");
  const ProcessResult result = session.remapc(
      {"export", "mitsuba_ward_to_mitsuba_as", "--fits", session.path("fits"), "--size", "5", "-o", table});
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  CHECK(result.output.empty());
  CHECK(result.errors.find("linear lookup deviates from the fit by at most") != std::string::npos);
  CHECK(read_file(table).starts_with("# format: remap-lookup\n# format_version: 1\n"));
  CHECK(data_lines(table)[0] == "source_alpha,target_alpha,target_f0_factor");
  CHECK(data_lines(table).size() == 6);
}

TEST_CASE("remapc export: what is unknown, too small or cannot be written is named", "[slow]") {
  const Session session;
  session.write("t.csv", made_table(8, 3));
  REQUIRE(session.remapc(session.fit("t.csv")).exit_code == 0);
  const auto export_to = [&](const std::string& file, std::vector<std::string> more = {}) {
    more.insert(more.begin(),
                {"export", session.path("fits/mitsuba_ward_to_mitsuba_as.json"), "-o", session.path(file)});
    return session.remapc(more);
  };
  check_failure(session.remapc({"export", "mitsuba_ward_to_mitsuba_az", "--fits", session.path("fits")}), 2,
                "did you mean mitsuba_ward_to_mitsuba_as?");
  check_failure(export_to("x.csv", {"--size", "1"}), 2, "--size: invalid value '1' (allowed: 2 to 1048576)");
  check_failure(export_to("x.csv", {"--size-specular", "-3"}), 2,
                "--size-specular: invalid value '-3' (allowed: 2 to 1048576)");
  check_failure(export_to("x.csv", {"--only", "color"}), 2, "--only");
  check_failure(export_to("t.csv/x.csv"), 1, "t.csv: folder cannot be created");
  check_failure(export_to("fits"), 1, "fits: cannot be written");
  CHECK_FALSE(fs::exists(session.path("x.csv")));
  ProcessLimits limits;
  limits.file_bytes = 512;
  check_failure(session.remapc({"export", session.path("fits/mitsuba_ward_to_mitsuba_as.json"), "-o",
                                session.path("full/x.csv")},
                               limits),
                1, "cannot be written");
  CHECK(fs::is_empty(session.path("full")));
}

TEST_CASE("remapc list: a folder without fits says so, and one that is none is an error") {
  const Session session;
  session.write("empty/readme.txt", "");
  const ProcessResult result = session.remapc({"list", "--fits", session.path("empty")});
  CHECK(result.exit_code == 0);
  CHECK(result.errors.find("no fits (*.json) in this folder") != std::string::npos);
  check_failure(session.remapc({"list", "--fits", session.path("none")}), 1, "none: not a folder");
}
