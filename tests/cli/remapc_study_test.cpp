// This file runs the program remap-study.
#include <algorithm>

#include <catch2/catch.hpp>

#include "cli/remapc_session.hpp"
#include "support/test_image.hpp"

using namespace remap;

namespace {

// Returns the arguments of a study of two pairs that takes a second.
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

// Returns the difference between the brightest and the darkest value of a picture.
float contrast(const std::string& path) {
  const TestImage image = read_image(path);
  const auto [darkest, brightest] = std::minmax_element(image.values.begin(), image.values.end());
  return *brightest - *darkest;
}

}  // namespace

TEST_CASE("remap-study environments: writes its comparisons and pictures", "[needs][slow]") {
  const Session session;
  // The second pair has no fit.
  const std::string fit = "mitsuba_ward_to_mitsuba_as.json";
  session.write("fits/" + fit, read_file(std::filesystem::path(REMAP_SOURCE_DIR "/fits") / fit));
  const ProcessResult result =
      require_success(session.study(small_study("-o study --pictures --least-error", session.path("fits"))));
  CHECK(result.output.empty());
  // There are the header and the rows: 11 pairs of models and methods, 2 alphas, 3 environments.
  CHECK(line_count(session.content("study/environments.csv")) == 1 + 11 * 2 * 3);
  CHECK_THAT(session.content("study/environments.csv.json"), Catch::Contains("\"resolution\": \"16\""));
  for (const std::string name : {"sky", "overcast", "studio"})
    CHECK(contrast(session.path("study/spheres_" + name + ".png")) > 0.5f);
  check_failure(session.study(small_study("-o study")), 1,
                "study/environments.csv: already exists (--force overwrites)", "remap-study");
  require_success(session.study(small_study("-o study --force")));
}

TEST_CASE("remap-study environments: prints its comparisons after their settings", "[slow]") {
  const Session session;
  const ProcessResult result = require_success(session.study(small_study()));
  CHECK(result.output.find("# tool: remap-study ") == 0);
  CHECK_THAT(result.output,
             Catch::Contains("\n# resolution: 16\n") && Catch::Contains("\nsource,target,alpha,"));
  // There are 6 comments, the header, and the rows: 10 pairs of models and methods, 2 alphas, 3 environments.
  CHECK(line_count(result.output) == 7 + 10 * 2 * 3);
  CHECK(session.file_count() == 0);
}

TEST_CASE("remap-study workflows: writes comparisons, round trips and pictures", "[needs][slow]") {
  const Session session;
  session.write("materials.csv",
                "material,group,alpha,diffuse_r,diffuse_g,diffuse_b,f0_r,f0_g,f0_b\n"
                "red,paint,0.2,0.9,0.1,0,0.04,0.04,0.05\nblue,metal,0.5,0,0,0,0.3,0.3,0.9\n");
  session.write("none/remark.txt", "");
  const Words small = "workflows materials.csv --samples 64 --resolution 16 --fits none --family-count 50";
  const ProcessResult result = require_success(session.study(small + "-o study --pictures"));
  CHECK(result.output.empty());
  // There are the header and the rows: 2 materials by 7 plain methods and 5 of glTF, under three environments
  // and the headlight.
  const std::string csv = session.content("study/workflows.csv");
  CHECK(line_count(csv) == 1 + 2 * (7 + 5) * 4);
  // Every method has three families. Khronos' solver and both means are in both conventions.
  CHECK(line_count(session.content("study/workflows_round_trips.csv")) == 1 + (6 + 4) * 3);
  CHECK(contrast(session.path("study/workflows_sky.png")) > 0.5f);
  const ProcessResult printed = require_success(session.study(small));
  CHECK(printed.output.substr(printed.output.find("convention,")) == csv);
}
