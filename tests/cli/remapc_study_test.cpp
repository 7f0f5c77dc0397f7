// `remapc study` as a person meets it.
#include <algorithm>

#include <catch2/catch.hpp>

#include "cli/remapc_session.hpp"
#include "support/skip.hpp"
#include "support/test_image.hpp"

using namespace remap;

namespace {

// A study of two pairs that takes a second.
std::vector<std::string> small_study(const std::vector<std::string>& more = {},
                                     const std::string& fits = REMAP_SOURCE_DIR "/fits") {
  std::vector<std::string> arguments = {"study",        "environments",
                                        "--pair",       "mitsuba/ward:mitsuba/as",
                                        "--pair",       "mitsuba/beckmann:mitsuba/ggx",
                                        "--alphas",     "0.2,0.5",
                                        "--resolution", "16",
                                        "--samples",    "64",
                                        "--fits",       fits};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// Of a picture: its brightest value less its darkest one.
float contrast(const std::string& path) {
  const TestImage image = read_image(path);
  const auto [darkest, brightest] = std::minmax_element(image.values.begin(), image.values.end());
  return *brightest - *darkest;
}

// Drawn by gnuplot, where that is installed.
void check_plot(const Session& session, const ProcessResult& result, const std::string& name) {
  if (result.errors.find(name + " is not drawn") != std::string::npos)
    return skip("gnuplot", "not installed");
  CHECK_THAT(read_file(session.path("study/" + name)), Catch::Contains("</svg>"));
}

}  // namespace

TEST_CASE("remapc study environments: writes tables and says what was found") {
  const Session session;
  // A fit of the one pair, none of the other.
  const std::string fit = "mitsuba_ward_to_mitsuba_as.json";
  session.write("fits/" + fit, read_file(std::filesystem::path(REMAP_SOURCE_DIR "/fits") / fit));
  const ProcessResult result = session.remapc(
      small_study({"-o", session.path("study"), "--pictures", "--floor"}, session.path("fits")));
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  CHECK(result.output.find("Spheres under sky, overcast, studio, mean luminance 1; alpha 0.2, 0.5, ") == 0);
  CHECK(result.output.find("shipped (1 of 2 pairs)") != std::string::npos);
  CHECK(result.output.find("natural is worse than copying for no pair.") != std::string::npos);
  CHECK(result.output.find("mitsuba/beckmann -> mitsuba/ggx has no fit") != std::string::npos);
  // 5 comments, the header; 9 pairs of models and methods, 2 alphas, 3 environments.
  CHECK(line_count(read_file(session.path("study/environments.csv"))) == 6 + 9 * 2 * 3);
  // Means of 5 methods over all pairs, and of the 9.
  CHECK(line_count(read_file(session.path("study/environments_summary.csv"))) == 6 + 5 + 9);
  check_plot(session, result, "environments.svg");
  for (const std::string name : {"sky", "overcast", "studio"})
    CHECK(contrast(session.path("study/spheres_" + name + ".png")) > 0.5f);
}

TEST_CASE("remapc study environments: --json has the means of each method and pair") {
  const Session session;
  const ProcessResult result = session.remapc(small_study({"--json"}));
  REQUIRE(result.exit_code == 0);
  for (const std::string key : {"\"noise_percent\": ", "\"copy\": {", "\"shipped\": {",
                                "\"rmse_percent\": ", "\"worse_than_copy\": [", "\"target\": \"mitsuba/as\""})
    CHECK(result.output.find(key) != std::string::npos);
  CHECK(session.file_count() == 0);
}

TEST_CASE("remapc study environments: wrong usage is exit code 2, files that are no maps are 1") {
  const Session session;
  check_failure(session.remapc({"study"}), 2, "is missing");
  check_failure(session.remapc(small_study({"--pair", "mitsuba/ward"})), 2, "expected SOURCE:TARGET");
  check_failure(session.remapc(small_study({"--pair", "mitsuba/wart:mitsuba/as"})), 2,
                "did you mean mitsuba/ward?");
  check_failure(session.remapc(small_study({"--exposure", "0"})), 2, "--exposure: 0; expected more than 0");
  check_failure(session.remapc(small_study({"--pictures"})), 2, "expected -o FOLDER");
  check_failure(session.remapc(small_study({"--environment", session.path("none.exr")})), 1,
                "none.exr: cannot be read");
  CHECK(session.file_count() == 0);
}

TEST_CASE("remapc study environments: has help with an example") {
  const ProcessResult result = Session().remapc({"study", "environments", "--help"});
  CHECK(result.exit_code == 0);
  CHECK(result.output.find("Example:\n  remapc study environments") != std::string::npos);
}

TEST_CASE("remapc study workflows: writes tables, pictures and words, and says what was left out") {
  const Session session;
  const std::vector<std::string> small = {
      "study", "workflows",    "--count", "2",      "--alphas",           "0.2,0.5",        "--samples",
      "64",    "--resolution", "16",      "--fits", session.path("none"), "--family-count", "50"};
  session.write("none/remark.txt", "");
  std::vector<std::string> full = small;
  full.insert(full.end(), {"-o", session.path("study"), "--pictures"});
  const ProcessResult result = session.remapc(full);
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  CHECK(result.output.find("6 materials at alpha 0.2, 0.5 under 3 environments") == 0);
  CHECK(result.output.find("Left out: no materials of the group ngan") != std::string::npos);
  CHECK(result.output.find("Left out: no network among the fits") != std::string::npos);
  // 5 comments, the header; 6 materials by 7 methods plain and 5 of glTF.
  CHECK(line_count(read_file(session.path("study/workflows.csv"))) == 6 + 6 * (7 + 5));
  CHECK(line_count(read_file(session.path("study/workflows_summary.csv"))) == 6 + (7 + 5) * 4);
  check_plot(session, result, "workflows.svg");
  CHECK(contrast(session.path("study/workflows_sky.png")) > 0.5f);
  std::vector<std::string> json = small;
  json.emplace_back("--json");
  const std::string figures = session.remapc(json).output;
  for (const std::string key :
       {"\"gltf\": {", "\"projection\": {", "\"worst_ssim\": ", "\"uniform, 8-bit\": {"})
    CHECK(figures.find(key) != std::string::npos);
  check_failure(session.remapc({"study", "workflows", "--pictures"}), 2, "expected -o FOLDER");
}

TEST_CASE("remapc study warp: figures as JSON, tables, a plot and sheets") {
  const Session session;
  const ProcessResult result =
      session.remapc({"study", "warp", "--size", "32", "--stroke-sets", "1", "--material", "wood", "--json",
                      "-o", session.path("study"), "--pictures"});
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  for (const std::string key :
       {"\"method\": {", "\"registration\": {", "\"dimensions\": {", "\"points\": {", "\"nodes\": {",
        "\"error\": ", "\"folds\": ", "\"table_difference\": ", "\"wood\": {", "\"seconds\": "})
    CHECK(result.output.find(key) != std::string::npos);
  CHECK(read_file(session.path("study/warp.csv")).find("\nwood,0,method,registration,") != std::string::npos);
  CHECK(read_file(session.path("study/warp_sensitivity.csv"))
            .find("\nset,group,variant,first,second,change\n") != std::string::npos);
  for (const std::string name : {"methods", "sampling", "strokes"})
    CHECK(contrast(session.path("study/warp_" + name + "_wood.png")) > 0.2f);
  check_plot(session, result, "warp.svg");
}

TEST_CASE("remapc study warp: wrong usage is exit code 2, folders without sets are 1") {
  const Session session;
  check_failure(session.remapc({"study", "warp", "--size", "8"}), 2, "--size: 8; expected 32 to 2048");
  check_failure(session.remapc({"study", "warp", "--stroke-sets", "0"}), 2, "expected 1 to 100");
  check_failure(session.remapc({"study", "warp", "--pictures"}), 2, "expected -o FOLDER");
  check_failure(session.remapc({"study", "warp", "--material", "moss"}), 2, "moss");
  check_failure(session.remapc({"study", "warp", "--sets", session.path("none")}), 1, "none: cannot be read");
  CHECK(session.file_count() == 0);
}
