// Runs `remapc sweep` with stages and diffuse, `remapc sample`, and the study of dielectrics.
#include <filesystem>

#include <catch2/catch.hpp>

#include "cli/remapc_session.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> study(const Session& session, const std::string& name,
                               const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {name, "-o", session.path(name), "--resolution", "32"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace

TEST_CASE("remapc sweep: stages and diffuse give columns that check and fit accept", "[slow]") {
  const Session session;
  for (const std::string stages : {"1", "2", "3"}) {
    auto arguments = session.sweep("t" + stages + ".csv");
    arguments.insert(arguments.end(), {"--stages", stages, "--diffuse", "0.25"});
    const ProcessResult result = session.remapc(arguments);
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const std::string table = read_file(session.path("t" + stages + ".csv"));
    CHECK(table.find("# stages: " + stages + "\n") != std::string::npos);
    CHECK(table.find("# irradiance_scale: 1\n") != std::string::npos);
    CHECK(table.find("alpha1,specular1,alpha2,specular2,diffuse1,diffuse2,error,status\n") !=
          std::string::npos);
  }
  CHECK(session.remapc({"check", session.path("t2.csv")}).exit_code == 0);
  CHECK(session.remapc(session.fit("t2.csv")).exit_code == 0);
}

TEST_CASE("remapc sweep: models with an index are swept in F0") {
  const Session session;
  const ProcessResult result = session.remapc({"sweep", "--source", "mitsuba/as-ior", "--target",
                                               "mitsuba/ggx-ior", "--resolution", "48", "--roughness-samples",
                                               "3", "--specular-samples", "3", "-o", session.path("t.csv")});
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  const std::string table = read_file(session.path("t.csv"));
  CHECK(table.find("# source_specular: ior\n") != std::string::npos);
  CHECK(table.find("# target_specular_law: ior\n") != std::string::npos);
  CHECK(table.find("# target_specular_column: f0\n") != std::string::npos);
  CHECK(table.find("3 specular 0 to 0.36\n") != std::string::npos);
}

TEST_CASE("remapc sweep: invalid stages, diffuse and conductors give exit code 2", "[slow]") {
  const Session session;
  auto arguments = session.sweep("t.csv");
  arguments.insert(arguments.end(), {"--stages", "4"});
  check_failure(session.remapc(arguments), 2, "--stages: invalid value '4' (allowed: 1 to 3)");
  arguments = session.sweep("t.csv");
  arguments.insert(arguments.end(), {"--diffuse", "2"});
  check_failure(session.remapc(arguments), 2, "diffuse 2 is out of range (0 to 1)");
  arguments = session.sweep("t.csv");
  arguments[2] = "mitsuba/as-conductor";
  check_failure(session.remapc(arguments), 2, "has no parameter for specular");
  CHECK(session.file_count() == 0);
}

TEST_CASE("remap-study dielectrics: compares one, two and three stages") {
  const Session session;
  const ProcessResult result = session.study(study(session, "dielectrics", {"--alphas", "0.3", "--json"}));
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  CHECK(result.output.find("\"stages\": 3") != std::string::npos);
  CHECK(result.output.find("\"jumps\": false") != std::string::npos);
  CHECK(result.output.find("figure 10: three stages lower") != std::string::npos);
  CHECK(result.output.find("null") == std::string::npos);
  for (const std::string file :
       {"stages1.csv", "stages2.csv", "stages3.csv", "guesses.csv", "dielectrics.csv"})
    CHECK(fs::exists(session.path("dielectrics/" + file)));
}

TEST_CASE("remap-study: wrong usage gives exit code 2, help has an example", "[slow]") {
  const Session session;
  const auto fails = [&](const std::vector<std::string>& arguments, const std::string& message) {
    check_failure(session.study(arguments), 2, message, "remap-study");
  };
  fails({}, "no command given (try --help)");
  fails({"dielectric"}, "dielectrics");
  fails(study(session, "dielectrics", {"--alphas", "0.4,0.2"}),
        "--alphas: values must increase and lie between 0.01 and 1");
  fails(study(session, "dielectrics", {"--diffuse", "-1"}), "--diffuse: -1 is out of range (0 to 1)");
  CHECK(session.file_count() == 0);
  CHECK(session.study({"dielectrics", "--help"}).output.find("Example:\n  remap-study dielectrics") !=
        std::string::npos);
}

TEST_CASE("remapc sample: a table of named columns that check reads and fit --swap inverts", "[slow]") {
  const Session session;
  const std::vector<std::string> sample = {"sample",       "--source",    "mitsuba/ggx-metallic",
                                           "--target",     "mitsuba/ggx", "--vary",
                                           "metallic",     "--range",     "roughness=0.4,0.9",
                                           "--resolution", "32",          "--count",
                                           "50",           "--seed",      "7",
                                           "--json",       "-o",          session.path("t.csv")};
  const ProcessResult result = session.remapc(sample);
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  CHECK(result.output.find("\"rows\": 50") != std::string::npos);
  CHECK(result.output.find("\"base_color_g1\"") != std::string::npos);
  CHECK(session.remapc({"check", session.path("t.csv")}).exit_code == 0);
  check_failure(session.remapc({"fit", session.path("t.csv")}), 2,
                "is exact by equation (2) and needs no fit (use --swap");
  check_failure(session.remapc(sample), 1, "already exists (--force overwrites)");
  check_failure(session.remapc({"sample", "--source", "mitsuba/ggx", "--target", "mitsuba/ggx", "--range",
                                "alpha=0.5", "-o", session.path("u.csv")}),
                2, "(write NAME=MIN,MAX");
}

TEST_CASE("remapc sweep: roles and fixed values of parameters are given on the command line", "[slow]") {
  const Session session;
  const auto sweep = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"sweep",
                                          "--source",
                                          "mitsuba/ggx-metallic",
                                          "--target",
                                          "mitsuba/ggx",
                                          "--resolution",
                                          "32",
                                          "--roughness-samples",
                                          "2",
                                          "--specular-samples",
                                          "2",
                                          "--force",
                                          "-o",
                                          session.path("t.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return session.remapc(arguments);
  };
  const ProcessResult result = sweep({"--source-specular", "metallic", "--source-set", "base_color=0.8"});
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  const std::string table = read_file(session.path("t.csv"));
  CHECK(table.find("# source_specular: metallic\n# source_fixed: base_color=0.8,specular=0.5\n") !=
        std::string::npos);
  check_failure(sweep({"--source-set", "metalic=1"}), 2, "did you mean metallic?");
  check_failure(sweep({"--source-set", "metallic=1,0,0"}), 2, "3 values given (give one");
  check_failure(sweep({"--target-set", "diffuse"}), 2, "'=' missing (write NAME=VALUE or NAME=R,G,B)");
}

TEST_CASE("remapc preview: writes pictures and figures of a committed fit", "[slow]") {
  const Session session;
  const ProcessResult result =
      session.remapc({"preview", "mitsuba_ward_to_mitsuba_ggx", "--fits", REMAP_SOURCE_DIR "/fits", "--alpha",
                      "0.2,0.5", "--resolution", "32", "--json", "-o", session.path("p.png")});
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  CHECK(result.output.find("\"shape\": \"torus\"") != std::string::npos);
  CHECK(std::filesystem::exists(session.path("p.png")));
  check_failure(session.remapc({"preview", "mitsuba_ward_to_mitsuba_gg", "--fits", REMAP_SOURCE_DIR "/fits"}),
                2, "did you mean mitsuba_ward_to_mitsuba_ggx?");
  check_failure(session.remapc({"preview", "mitsuba_ward_to_mitsuba_ggx", "--fits", REMAP_SOURCE_DIR "/fits",
                                "--shape", "tours"}),
                2, "did you mean torus?");
}
