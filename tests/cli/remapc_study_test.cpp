// Runs the program remap-study.
#include <algorithm>

#include <catch2/catch.hpp>

#include "cli/remapc_session.hpp"
#include "support/skip.hpp"
#include "support/test_image.hpp"

using namespace remap;

namespace {

// The arguments of a study of two pairs that takes a second.
std::vector<std::string> small_study(const Words& more = {},
                                     const std::string& fits = REMAP_SOURCE_DIR "/fits") {
  Words arguments =
      ("environments --pair mitsuba/ward:mitsuba/as --pair mitsuba/beckmann:mitsuba/ggx --alphas 0.2,0.5 "
       "--resolution 16 --samples 64 --fits " +
       fits);
  arguments += more;
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

// What gnuplot draws, where it is installed.
void check_plot(const Session& session, const ProcessResult& result, const std::string& name) {
  if (has_program("gnuplot"))
    CHECK_THAT(session.content("study/" + name), Catch::Contains("</svg>"));
  else
    CHECK_THAT(result.errors, Catch::Contains(name + " was not drawn"));
}

}  // namespace

TEST_CASE("remap-study environments: writes tables and a summary", "[needs][slow]") {
  const Session session;
  // Only the first pair has a fit.
  const std::string fit = "mitsuba_ward_to_mitsuba_as.json";
  session.write("fits/" + fit, read_file(std::filesystem::path(REMAP_SOURCE_DIR "/fits") / fit));
  const ProcessResult result =
      require_success(session.study(small_study("-o study --pictures --least-error", session.path("fits"))));
  CHECK(result.output.find("Spheres under sky, overcast, studio, mean luminance 1; alpha 0.2, 0.5, ") == 0);
  CHECK(result.output.find("shipped (1 of 2 pairs)") != std::string::npos);
  CHECK(result.output.find("With `natural-2`, no pair is worse than copying.") != std::string::npos);
  CHECK(result.output.find("mitsuba/beckmann -> mitsuba/ggx has no fit") != std::string::npos);
  // 6 comments, the header; 11 pairs of models and methods, 2 alphas, 3 environments.
  CHECK(line_count(session.content("study/environments.csv")) == 1 + 11 * 2 * 3);
  // Means of 6 methods over all pairs, and of the 11.
  CHECK(line_count(session.content("study/environments_summary.csv")) == 1 + 6 + 11);
  check_plot(session, result, "environments.svg");
  for (const std::string name : {"sky", "overcast", "studio"})
    CHECK(contrast(session.path("study/spheres_" + name + ".png")) > 0.5f);
  check_failure(session.study(small_study("-o study")), 1,
                "study/environments.csv: already exists (--force overwrites)", "remap-study");
  require_success(session.study(small_study("-o study --force")));
}

TEST_CASE("remap-study environments: --json has the means of each method and pair", "[slow]") {
  const Session session;
  const ProcessResult result = require_success(session.study(small_study("--json")));
  for (const std::string key : {"\"noise_percent\": ", "\"copy\": {", "\"shipped\": {",
                                "\"rmse_percent\": ", "\"worse_than_copy\": [", "\"target\": \"mitsuba/as\""})
    CHECK(result.output.find(key) != std::string::npos);
  CHECK(session.file_count() == 0);
}

TEST_CASE("remap-study workflows: writes tables, pictures, a summary and notes", "[needs][slow]") {
  const Session session;
  const Words small =
      "workflows --count 2 --alphas 0.2,0.5 --samples 64 --resolution 16 --fits none --family-count 50";
  session.write("none/remark.txt", "");
  const ProcessResult result = require_success(session.study(small + "-o study --pictures"));
  CHECK(result.output.find("6 materials at alpha 0.2, 0.5 under 3 environments") == 0);
  CHECK(result.output.find("Note: the group ngan has no materials") != std::string::npos);
  CHECK(result.output.find("Note: the fits contain no network") != std::string::npos);
  // 5 comments, the header; 6 materials by 7 methods plain and 5 of glTF.
  CHECK(line_count(session.content("study/workflows.csv")) == 1 + 6 * (7 + 5));
  CHECK(line_count(session.content("study/workflows_summary.csv")) == 1 + (7 + 5) * 4);
  check_plot(session, result, "workflows.svg");
  CHECK(contrast(session.path("study/workflows_sky.png")) > 0.5f);
  const std::string figures = session.study(small + "--json").output;
  for (const std::string key :
       {"\"gltf\": {", "\"projection\": {", "\"worst_ssim\": ", "\"uniform, 8-bit\": {"})
    CHECK(figures.find(key) != std::string::npos);
}
