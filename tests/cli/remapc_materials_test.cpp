// This file tests `remapc sweep` with stages and diffuse, and `remapc sample`.
#include <filesystem>

#include <catch2/catch.hpp>

#include "cli/remapc_session.hpp"
#include "support/test_image.hpp"

using namespace remap;

TEST_CASE("remapc sweep: stages and diffuse give columns that check and fit accept", "[slow]") {
  const Session session;
  for (const std::string stages : {"1", "2", "3"}) {
    auto arguments = session.sweep("t" + stages + ".csv");
    arguments += "--stages " + stages + " --diffuse 0.25";
    const ProcessResult result = require_success(session.remapc(arguments));
    const std::string made = session.content("t" + stages + ".csv.json");
    CHECK(made.find("\"stages\": \"" + stages + "\"") != std::string::npos);
    CHECK(made.find("\"irradiance_scale\": \"1\"") != std::string::npos);
    CHECK(session.content("t" + stages + ".csv")
              .starts_with("alpha1,specular1,alpha2,specular2,diffuse1,diffuse2,error,status\n"));
  }
  CHECK(session.remapc("check t2.csv").exit_code == 0);
  CHECK(session.remapc(session.fit("t2.csv") + "--source made/ward --target made/as").exit_code == 0);
}

TEST_CASE("remapc sweep: models with an index are swept in F0") {
  const Session session;
  const ProcessResult result =
      require_success(session.remapc("sweep --source mitsuba/as-ior --target mitsuba/ggx-ior --resolution 48 "
                                     "--roughness-samples 3 --specular-samples 3 -o t.csv"));
  const std::string table = session.content("t.csv.json");
  CHECK(table.find("\"source_specular\": \"ior\"") != std::string::npos);
  CHECK(table.find("\"target_specular_law\": \"ior\"") != std::string::npos);
  CHECK(table.find("\"target_specular_column\": \"f0\"") != std::string::npos);
  CHECK(table.find("3 specular 0 to 0.36\"") != std::string::npos);
}

TEST_CASE("remapc sample: a table of named columns that check reads and fit --swap inverts", "[slow]") {
  const Session session;
  const ProcessResult result = require_success(session.remapc(Words(
      "sample --source mitsuba/ggx-metallic --target mitsuba/ggx --vary metallic --range roughness=0.4,0.9 "
      "--resolution 32 --count 50 --seed 7 --json -o " +
      session.path("t.csv"))));
  CHECK(result.output.find("\"rows\": 50") != std::string::npos);
  CHECK(result.output.find("\"base_color_g1\"") != std::string::npos);
  CHECK(session.remapc("check t.csv").exit_code == 0);
}

TEST_CASE("remapc sweep: roles and fixed values of parameters are given on the command line") {
  const Session session;
  const ProcessResult result = require_success(
      session.remapc(Words("sweep --source mitsuba/ggx-metallic --target mitsuba/ggx --resolution 32 "
                           "--roughness-samples 2 --specular-samples 2 --source-specular metallic "
                           "--source-set base_color=0.8 -o " +
                           session.path("t.csv"))));
  const std::string table = session.content("t.csv.json");
  CHECK(
      table.find("\"source_specular\": \"metallic\",\n  \"source_fixed\": \"base_color=0.8,specular=0.5\"") !=
      std::string::npos);
}

TEST_CASE("remapc preview: writes pictures and figures of a committed fit", "[slow]") {
  const Session session;
  const ProcessResult result =
      require_success(session.remapc("preview mitsuba_ward_to_mitsuba_ggx --fits " REMAP_SOURCE_DIR "/fits"
                                     " --alpha 0.2,0.5 --resolution 32 --json -o p.png"));
  CHECK(result.output.find("\"light\": \"studio\"") != std::string::npos);
  CHECK(result.output.find("\"shape\": \"torus\"") == std::string::npos);
  const TestImage labelled = read_image(session.path("p.png"));
  require_success(session.remapc("preview mitsuba_ward_to_mitsuba_ggx --fits " REMAP_SOURCE_DIR "/fits"
                                 " --alpha 0.2,0.5 --resolution 32 --no-labels -o bare.png"));
  const TestImage bare = read_image(session.path("bare.png"));
  constexpr int kCell = 32 + 2 * 1;  // a picture with its margin
  CHECK(bare.spec.width == 3 * kCell);
  CHECK(bare.spec.height == 2 * kCell);
  CHECK(labelled.spec.width > bare.spec.width);
  CHECK(labelled.spec.height > bare.spec.height);
}
