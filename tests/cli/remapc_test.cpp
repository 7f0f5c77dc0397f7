// remapc as a person meets it: the chain of commands, and one wrong input a test with its message and exit
// code.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <catch2/catch.hpp>

#include "cli/remapc_session.hpp"
#include "model/interpreter.hpp"
#include "remap/fit_file.hpp"

using namespace remap;
namespace fs = std::filesystem;

TEST_CASE("remapc: sweep, check, fit, emit, eval, list and show work in a row") {
  const Session session;
  ProcessResult result = session.remapc(session.sweep("t.csv"));
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  CHECK(result.errors.find("36 rows (36 ok)") != std::string::npos);
  CHECK(session.remapc({"check", session.path("t.csv")}).exit_code == 0);
  REQUIRE(session.remapc(session.fit("t.csv")).exit_code == 0);
  const std::string fit = session.path("fits/mitsuba_ward_to_mitsuba_as.json");
  CHECK(load_fit(fit).table.comments.at("objective") == "natural");
  REQUIRE(session.remapc({"emit", "--all", "--fits", session.path("fits"), "-o", session.path("generated")})
              .exit_code == 0);
  CHECK(fs::exists(session.path("generated/converters.json")));
  result = session.remapc({"eval", fit, session.path("t.csv"), "--json"});
  CHECK(result.exit_code == 0);
  CHECK(result.output.find("\"rows\": 36") != std::string::npos);
  CHECK(result.output.find("\"fitted_from_this_table\": true") != std::string::npos);
  CHECK(session.remapc({"list", "--fits", session.path("fits")}).output.find("parametric") !=
        std::string::npos);
  result = session.remapc({"show", "mitsuba_ward_to_mitsuba_as", "--fits", session.path("fits")});
  CHECK(result.output.find("mitsuba/as (alpha, f0)") != std::string::npos);
}

TEST_CASE("remapc eval --grid: prints what the interpreter gives over the domain, without a table") {
  const Session session;
  session.write("t.csv", made_table(8, 3));
  REQUIRE(session.remapc(session.fit("t.csv")).exit_code == 0);
  const std::string path = session.path("fits/mitsuba_ward_to_mitsuba_as.json");
  const Fit fit = load_fit(path);
  std::string expected = "source_alpha,source_specular,target_alpha,target_f0\n";
  const Range widths = own_roughness_range(fit), speculars = specular_range(fit);
  for (const double width : {widths.min, (widths.min + widths.max) / 2.0, widths.max})
    for (const double specular : {speculars.min, (speculars.min + speculars.max) / 2.0, speculars.max}) {
      double out = 0.0;
      const double target = evaluate_texel(fit, width, {&specular, 1}, {&out, 1});
      for (const double value : {width, specular, target}) expected += number_text(value) + ",";
      expected += number_text(out) + "\n";
    }
  CHECK(session.remapc({"eval", path, "--grid", "3"}).output == expected);
  const std::string file = session.path("new/grid.csv");
  CHECK(session.remapc({"eval", path, "--grid", "3", "-o", file}).output.empty());
  CHECK(read_file(file) == expected);
  check_failure(session.remapc({"eval", path}), 2, "name a table, or use --grid");
  check_failure(session.remapc({"eval", path, session.path("t.csv"), "--grid", "3"}), 2, "name a table, or");
  check_failure(session.remapc({"eval", path, session.path("t.csv"), "-o", file}), 2, "only be used with");
  check_failure(session.remapc({"eval", path, "--grid", "1"}), 2, "--grid: invalid value '1'");
}

TEST_CASE("remapc list: a folder without fits says so, and one that is none is an error") {
  const Session session;
  session.write("empty/readme.txt", "");
  const ProcessResult result = session.remapc({"list", "--fits", session.path("empty")});
  CHECK(result.exit_code == 0);
  CHECK(result.errors.find("no fits (*.json) in this folder") != std::string::npos);
  check_failure(session.remapc({"list", "--fits", session.path("none")}), 1, "none: not a folder");
}

TEST_CASE("remapc: every command has help with an example", "[slow]") {
  const Session session;
  for (const std::string command :
       {"render", "preview", "sweep", "sample", "check", "fit", "emit", "eval", "compare", "list", "show"}) {
    const ProcessResult result = session.remapc({command, "--help"});
    CHECK(result.exit_code == 0);
    CHECK(result.output.find("Example:\n  remapc " + command) != std::string::npos);
  }
  CHECK(session.remapc({"--version"}).output == "remapc " REMAPC_VERSION "\n");
}

TEST_CASE("remapc: wrong usage is exit code 2 and names the nearest", "[slow]") {
  const Session session;
  check_failure(session.remapc({}), 2, "no command given (try --help)");
  check_failure(session.remapc({"swep"}), 2, "did you mean sweep?");
  check_failure(session.remapc({"sweep", "--sorce", "a"}), 2, "did you mean --source?");
  check_failure(session.remapc({"sweep", "--source", "mitsuba/wardd", "--target", "mitsuba/as", "-o",
                                session.path("t")}),
                2, "did you mean mitsuba/ward?");
  check_failure(session.remapc({"sweep", "--source", "mitsuba/ward", "--target", "nothing/like", "-o",
                                session.path("t")}),
                2, "(choose mitsuba/ward, ");
  auto sweep = session.sweep("t.csv");
  sweep.insert(sweep.end(), {"--objective", "natura"});
  check_failure(session.remapc(sweep), 2, "did you mean natural?");
  sweep = session.sweep("t.csv");
  sweep.insert(sweep.end(), {"--specular-samples", "-1"});
  check_failure(session.remapc(sweep), 2, "--specular-samples: invalid value '-1' (allowed: 1 to 4096)");
  sweep = session.sweep("t.csv");
  sweep.insert(sweep.end(), {"--roughness-range", "0.5,2"});
  check_failure(session.remapc(sweep), 2, "is out of range (");
  check_failure(session.remapc({"show", "nix", "--fits", session.path("")}), 2, "neither a file nor a fit");
  CHECK(session.file_count() == 0);
}

TEST_CASE("remapc check: a bad number is named by file, line and column") {
  const Session session;
  session.write("t.csv", kHeader + "0.1,0.2,0.3,0.4,0,ok\n0.1,zwei,0.3,0.4,0,ok\n");
  check_failure(session.remapc({"check", session.path("t.csv")}), 1, "t.csv:3:5: specular1 is \"zwei\"");
}

TEST_CASE("remapc check: a wrong delimiter and a missing column are named") {
  const Session session;
  session.write("a.csv", "alpha1|specular1|alpha2|specular2\n1|2|3|4\n");
  check_failure(session.remapc({"check", session.path("a.csv")}), 1, "comma, tab or semicolon");
  session.write("b.csv", "alpha1,specular1,alpha2\n1,2,3\n");
  check_failure(session.remapc({"check", session.path("b.csv")}), 1, "has no column specular2");
}

TEST_CASE("remapc check and fit: a table that cannot be fitted is exit code 1, and no fit is written") {
  const Session session;
  session.write("few.csv", "# source: a/b\n# target: c/d\n" + kHeader + "0.1,0.2,0.3,0.4,0,ok\n");
  const ProcessResult check = session.remapc({"check", session.path("few.csv")});
  check_failure(check, 1, "1 error prevents a fit");
  CHECK(check.output.find("rows: 1 usable rows") != std::string::npos);
  check_failure(session.remapc({"fit", session.path("few.csv"), "-o", session.path("fits")}), 1,
                "1 usable rows");
  CHECK_FALSE(fs::exists(session.path("fits")));
}

TEST_CASE("remapc sweep: an output folder that cannot be is named before the work starts") {
  const Session session;
  session.write("file", "x");
  auto sweep = session.sweep("file/t.csv");
  sweep[sweep.size() - 1] = session.path("file/t.csv");
  check_failure(session.remapc(sweep), 1, "folder");
}

TEST_CASE("remapc sweep: a table is not replaced unasked") {
  const Session session;
  session.write("t.csv", "mine");
  check_failure(session.remapc(session.sweep("t.csv")), 1, "already exists (--force overwrites)");
  CHECK(read_file(session.path("t.csv")) == "mine");
}

TEST_CASE("remapc sweep: a full disk is an error, and nothing lies under the final name") {
  const Session session;
  ProcessLimits limits;
  limits.file_bytes = 2048;
  check_failure(session.remapc(session.sweep("t.csv"), limits), 1, "cannot be written");
  CHECK_FALSE(fs::exists(session.path("t.csv")));
}

TEST_CASE("remapc fit, emit and render: a full disk is an error, and nothing lies under the final name",
          "[slow]") {
  const Session session;
  REQUIRE(session.remapc(session.sweep("t.csv")).exit_code == 0);
  REQUIRE(session.remapc(session.fit("t.csv")).exit_code == 0);
  const std::string fit = session.path("fits/mitsuba_ward_to_mitsuba_as.json");
  ProcessLimits limits;
  limits.file_bytes = 1024;
  check_failure(session.remapc(session.fit("t.csv", "out"), limits), 1, "cannot be written");
  check_failure(session.remapc({"emit", fit, "-o", session.path("out")}, limits), 1, "cannot be written");
  check_failure(session.remapc({"render", "--model", "mitsuba/ward", "--set", "alpha=0.5", "--set",
                                "specular=0.5", "-o", session.path("out/s.exr")},
                               limits),
                1, "cannot be written");
  CHECK(fs::is_empty(session.path("out")));
}

TEST_CASE("remapc sweep: killed or interrupted it leaves nothing under the final name") {
  const Session session;
  for (const int signal : {SIGKILL, SIGTERM}) {
    auto arguments = session.sweep("broken.csv");
    arguments[6] = "512";  // seconds of work
    arguments[8] = "400";
    arguments.insert(arguments.begin(), REMAPC_PROGRAM);
    Process process(arguments);
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
    process.send(signal);
    const ProcessResult result = process.wait();
    CHECK((signal == SIGKILL ? result.signal == SIGKILL : result.exit_code == 1));
    CHECK_FALSE(fs::exists(session.path("broken.csv")));
  }
}

TEST_CASE("remapc emit: --check finds a changed, a missing and an orphaned header", "[slow]") {
  const Session session;
  REQUIRE(session.remapc(session.sweep("t.csv")).exit_code == 0);
  REQUIRE(session.remapc(session.fit("t.csv")).exit_code == 0);
  const std::vector<std::string> emit = {
      "emit", "--all", "--fits", session.path("fits"), "-o", session.path("generated")};
  REQUIRE(session.remapc(emit).exit_code == 0);
  auto check = emit;
  check.emplace_back("--check");
  CHECK(session.remapc(check).exit_code == 0);

  const std::string header = session.path("generated/mitsuba_ward_to_mitsuba_as.hpp");
  const std::string original = read_file(header);
  write_file(header, original + "\n");
  check_failure(session.remapc(check), 1, "out of date (run `remapc emit --all`)");
  CHECK(session.remapc(check).output.find("differs from its fit") != std::string::npos);
  fs::remove(header);
  CHECK(session.remapc(check).output.find(".hpp: missing") != std::string::npos);
  write_file(header, original);
  session.write("generated/old_to_gone.hpp", "");
  CHECK(session.remapc(check).output.find("old_to_gone.hpp: no fit of this name") != std::string::npos);
}

TEST_CASE("remapc emit: a fit that is none is named with the field") {
  const Session session;
  session.write("fits/a_to_b.json", "{\"format\": \"remap-fit\", \"version\": 3}");
  check_failure(session.remapc({"emit", session.path("fits/a_to_b.json"), "-o", session.path("out")}), 1,
                "a_to_b.json: has no field \"id\"");
  CHECK_FALSE(fs::exists(session.path("out")));
  check_failure(session.remapc({"emit"}), 2, "no fits given (name fits, or use --all)");
}

TEST_CASE("remapc render: writes an EXR that OpenImageIO's own tools read") {
  const Session session;
  const ProcessResult result =
      session.remapc({"render", "--model", "mitsuba/ggx", "--set", "alpha=0.3", "--set", "f0=0.9,0.6,0.2",
                      "--light", "45", "--resolution", "32", "-o", session.path("s.exr")});
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  const ProcessResult info = run({"/usr/bin/oiiotool", "--info", "-v", session.path("s.exr")});
  CHECK(info.output.find("32 x   32, 3 channel, float openexr") != std::string::npos);
  CHECK(info.output.find("remap:model: \"mitsuba/ggx\"") != std::string::npos);
}

TEST_CASE("remapc render: wrong parameters, files and folders are named", "[slow]") {
  const Session session;
  const auto render = [&](std::vector<std::string> more, const std::string& file) {
    std::vector<std::string> arguments = {"render", "--model", "mitsuba/ggx",     "--resolution",
                                          "16",     "-o",      session.path(file)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return session.remapc(arguments);
  };
  check_failure(render({"--set", "alpha=0.3"}, "s.exr"), 2, "parameter f0 is required (--set f0=VALUE)");
  check_failure(render({"--set", "alpha=0.3", "--set", "f0=x"}, "s.exr"), 2, "'x' is not a number");
  check_failure(render({"--set", "alpha=0.3", "--set", "f0=0.5", "--set", "alhpa=1"}, "s.exr"), 2,
                "did you mean alpha?");
  check_failure(render({"--set", "alpha=0.3", "--set", "f0=0.5"}, "s.png"), 2, "the extension must be .exr");
  session.write("file", "x");
  check_failure(render({"--set", "alpha=0.3", "--set", "f0=0.5"}, "file/s.exr"), 1, "folder");
  CHECK(session.file_count() == 1);
}
